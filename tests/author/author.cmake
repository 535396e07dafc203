# The meshes of the thesis' author are not ours to ship: -DMORTISE_AUTHOR_SCENES=<folder that holds them> declares these.
set(MORTISE_AUTHOR_SCENES "" CACHE PATH "Folder of the author's meshes (cog_master.msh, ...)")
if(MORTISE_AUTHOR_SCENES)
  foreach(order 1 2)
    foreach(own gears plates indenter)
      mortise_scene_test(${own}_${order} SCENE ${own} CHECK ../same/same.py LABELS cross mpi ARGS -cross_check -order ${order}
        -slave_dm_plex_filename ${MORTISE_AUTHOR_SCENES}/$<IF:$<STREQUAL:${own},gears>,cog,$<IF:$<STREQUAL:${own},plates>,plate,indent>>_slave.msh
        -master_dm_plex_filename ${MORTISE_AUTHOR_SCENES}/$<IF:$<STREQUAL:${own},gears>,cog,plate>_master.msh)
    endforeach()
  endforeach()
  mortise_scene_test(prisms CHECK ../same/same.py LABELS cross mpi ARGS -cross_check
    -slave_dm_plex_filename ${MORTISE_AUTHOR_SCENES}/prism_slave.msh
    -master_dm_plex_filename ${MORTISE_AUTHOR_SCENES}/prism_master.msh)
endif()
