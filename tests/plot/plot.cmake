# Pictures and pages: what they say, and where they say it.
mortise_scene_test(labels_ring SCENE shells CHECK labels.py ARGS -units mm,N,MPa -report)
mortise_scene_test(labels_plane SCENE two_plates CHECK labels.py ARGS -units m,N,Pa -report)
mortise_scene_test(labels_solid SCENE patch3d CHECK labels.py ARGS -units in,lbf,psi -report)
