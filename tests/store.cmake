dem_test(test_store SOURCES unit/test_store.cpp LIBRARIES dem_store)
