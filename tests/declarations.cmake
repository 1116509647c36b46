dem_test(test_declarations SOURCES unit/test_declarations.cpp LIBRARIES dem_models dem_study dem_reports
                                   nlohmann_json::nlohmann_json)
dem_test(test_words SOURCES unit/test_words.cpp LIBRARIES dem_core)
