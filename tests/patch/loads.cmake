# Strains without stress, and totals of sides: facts of statics and of Hooke's law, to rounding.
foreach(scene thermal thermal_plane thermal_turned totals totals_arch totals_ring)
  mortise_scene_test(${scene} CHECK ${scene}.py RANKS 1 LONG_RANKS 3)
endforeach()
