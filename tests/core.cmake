dem_test(test_core SOURCES unit/test_core.cpp LIBRARIES dem_core)
dem_test(test_rooms SOURCES unit/test_rooms.cpp LIBRARIES dem_core)
