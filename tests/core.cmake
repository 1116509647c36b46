dem_test(test_core SOURCES unit/test_core.cpp LIBRARIES dem_core)
dem_test(test_rooms SOURCES unit/test_rooms.cpp LIBRARIES dem_core)
dem_test(test_threads SOURCES unit/test_threads.cpp LIBRARIES dem_core Threads::Threads)
