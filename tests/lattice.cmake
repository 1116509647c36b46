dem_test(test_lattice_block SOURCES physics/test_lattice_block.cpp LIBRARIES dem_lattice)
dem_test(test_lattice_law SOURCES physics/test_lattice_law.cpp LIBRARIES dem_lattice)
dem_test(test_lattice_motion SOURCES physics/test_lattice_motion.cpp LIBRARIES dem_lattice)
