dem_test(test_texture_laws SOURCES physics/test_texture_laws.cpp LIBRARIES dem_texture)
dem_test(test_texture_assembly SOURCES physics/test_texture_assembly.cpp LIBRARIES dem_texture)
dem_test(test_texture_rate SOURCES physics/test_texture_rate.cpp LIBRARIES dem_texture LABELS long)
