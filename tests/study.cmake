dem_test(test_archive SOURCES unit/test_archive.cpp LIBRARIES dem_core)
dem_test(test_study SOURCES unit/test_study.cpp LIBRARIES dem_study dem_models)
dem_test(test_calibration SOURCES unit/test_calibration.cpp LIBRARIES dem_calibration)
