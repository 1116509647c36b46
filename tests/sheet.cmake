find_package(Eigen3 REQUIRED NO_MODULE)
dem_test(test_elle SOURCES unit/test_elle.cpp LIBRARIES dem_sheet)
dem_test(test_elle_scenarios SOURCES unit/test_elle_scenarios.cpp LIBRARIES dem_sheet)
dem_test(test_sheet_factor SOURCES physics/test_sheet_factor.cpp LIBRARIES dem_sheet)
add_test(NAME test_sheet_factor_sse2 COMMAND test_sheet_factor)  # the kernels that this processor would not take
set_tests_properties(test_sheet_factor_sse2 PROPERTIES TIMEOUT 600 ENVIRONMENT DEM_SIMD=sse2)
dem_test(test_sheet_elastic SOURCES physics/test_sheet_elastic.cpp LIBRARIES dem_sheet)
dem_test(test_sheet_notch SOURCES physics/test_sheet_notch.cpp LIBRARIES dem_sheet)
dem_test(test_sheet_breaks SOURCES physics/test_sheet_breaks.cpp physics/sheet_reference.cpp LIBRARIES dem_sheet
         Eigen3::Eigen)
dem_test(test_sheet_jumps SOURCES physics/test_sheet_jumps.cpp physics/sheet_reference.cpp LIBRARIES dem_sheet
         Eigen3::Eigen)
dem_test(test_sheet_breaks_100 SOURCES physics/test_sheet_breaks_100.cpp physics/sheet_reference.cpp
         LIBRARIES dem_sheet Eigen3::Eigen LABELS long)
