dem_test(test_options SOURCES cli/test_options.cpp LIBRARIES dem_cli)
