dem_test(test_lattice_law SOURCES physics/test_lattice_law.cpp LIBRARIES dem_lattice)
