# What is read off records once they are there.
dem_test(test_directions SOURCES unit/test_directions.cpp LIBRARIES dem_analysis)
dem_test(test_fragments SOURCES unit/test_fragments.cpp LIBRARIES dem_analysis)
dem_test(test_emission SOURCES unit/test_emission.cpp LIBRARIES dem_analysis)
dem_test(test_jump SOURCES unit/test_jump.cpp LIBRARIES dem_analysis)
