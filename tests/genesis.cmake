dem_test(test_genesis SOURCES physics/test_genesis.cpp LIBRARIES dem_texture dem_store)
# The published size: some 36,528 particles, a minute.
dem_test(test_genesis_paper SOURCES physics/test_genesis_paper.cpp LIBRARIES dem_texture LABELS long)
