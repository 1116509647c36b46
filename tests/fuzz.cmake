# Inputs changed at random, read under sanitizers: what reads is compiled for it once more, the rest comes as it is. A short run
# is a test; the long one has a million inputs each (ctest -L long).
set(fuzz_flags -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
add_library(dem_fuzz OBJECT fuzz/fuzz.cpp)
target_compile_definitions(dem_fuzz PRIVATE DEM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
target_link_libraries(dem_fuzz PRIVATE fmt::fmt dem_warnings)
target_include_directories(dem_fuzz PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_options(dem_fuzz PRIVATE -fsanitize=address)

# dem_fuzz(NAME INPUTS SOURCES a.cpp ... LIBRARIES x ...): the sources that it instruments, and what it links besides.
function(dem_fuzz name inputs)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  list(TRANSFORM ARG_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/engine/)
  add_executable(fuzz_${name} fuzz/fuzz_${name}.cpp ${ARG_SOURCES} $<TARGET_OBJECTS:dem_fuzz>)
  target_include_directories(fuzz_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_include_directories(fuzz_${name} SYSTEM PRIVATE ${DEM_RANDOM123} ${DEM_HDF5_INCLUDE})
  target_compile_options(fuzz_${name} PRIVATE ${fuzz_flags})
  target_link_options(fuzz_${name} PRIVATE ${fuzz_flags})
  target_link_libraries(fuzz_${name} PRIVATE ${ARG_LIBRARIES} fmt::fmt dem_warnings)
  add_test(NAME fuzz_${name} COMMAND fuzz_${name} ${inputs})
  add_test(NAME fuzz_${name}_long COMMAND fuzz_${name} 1000000 2)
  set_tests_properties(fuzz_${name} PROPERTIES TIMEOUT 600)
  set_tests_properties(fuzz_${name}_long PROPERTIES TIMEOUT 36000 LABELS long)
endfunction()

find_package(OpenSSL REQUIRED)
find_package(tomlplusplus REQUIRED)
dem_fuzz(scenario 1000 LIBRARIES dem_study dem_models tomlplusplus::tomlplusplus SOURCES
         core/files.cpp core/text.cpp scenario/convert.cpp scenario/keys.cpp scenario/reader.cpp scenario/scenario.cpp
         scenario/suggest.cpp scenario/units.cpp)
dem_fuzz(elle 70000 LIBRARIES dem_sheet SOURCES core/files.cpp core/text.cpp sheet/elle.cpp sheet/grains.cpp)
dem_fuzz(records 5000 LIBRARIES dem_store ${DEM_HDF5_LIBRARY} OpenSSL::Crypto SOURCES core/archive.cpp core/files.cpp
         core/hash.cpp core/record.cpp store/store.cpp)
