dem_test(test_archive SOURCES unit/test_archive.cpp LIBRARIES dem_core)
