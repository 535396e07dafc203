# What bench.py --search runs; built only when asked for.
mortise_objects(objects contact)
add_executable(bench_search EXCLUDE_FROM_ALL bench/search.c ${objects})
target_link_libraries(bench_search PRIVATE mortise_options)
add_executable(bench_stream EXCLUDE_FROM_ALL bench/stream.c)

# What adaptive.py --loop runs.
mortise_objects(objects study)
add_executable(bench_loop EXCLUDE_FROM_ALL bench/loop.c ${objects})
target_link_libraries(bench_loop PRIVATE mortise_options)
