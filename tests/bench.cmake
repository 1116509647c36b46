# Benchmarks, no tests: tests/bench/run builds and runs them. One JSON line a result.
foreach(part lattice render sheet texture)
  add_executable(bench_${part} bench/bench_${part}.cpp)
  target_link_libraries(bench_${part} PRIVATE dem_${part} fmt::fmt dem_warnings)
endforeach()
add_executable(bench_busy bench/bench_busy.cpp)
target_link_libraries(bench_busy PRIVATE dem_texture dem_lattice dem_sheet fmt::fmt dem_warnings)
