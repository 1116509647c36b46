# Not a test: prints one JSON line a result. bench_sheet [COLUMNS] [BREAKS] [THREADS]
add_executable(bench_sheet bench/bench_sheet.cpp)
target_link_libraries(bench_sheet PRIVATE dem_sheet fmt::fmt dem_warnings)
