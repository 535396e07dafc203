# What bench.py --search runs; built only when asked for.
set(objects)
foreach(room base kernel scene mesh contact)
  list(APPEND objects $<TARGET_OBJECTS:room_${room}>)
endforeach()
add_executable(bench_search EXCLUDE_FROM_ALL bench/search.c ${objects})
target_link_libraries(bench_search PRIVATE mortise_options)
