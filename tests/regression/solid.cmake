# Three dimensions.
foreach(order 1 2)
  mortise_scene_test(brick_hexahedra_${order} SCENE brick CHECK brick.py RANKS 1 3 ARGS -output_format xdmf,vtu -order ${order})
  mortise_scene_test(brick_tetrahedra_${order} SCENE brick CHECK brick.py RANKS 1 3 ARGS -output_format xdmf,vtu -order ${order} -brick_dm_plex_simplex 1)
endforeach()
