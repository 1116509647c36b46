dem_test(test_scenario SOURCES unit/test_scenario.cpp unit/test_scenario_errors.cpp unit/test_measured.cpp LIBRARIES dem_scenario)
