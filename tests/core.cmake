dem_test(test_core SOURCES unit/test_core.cpp LIBRARIES dem_core)
