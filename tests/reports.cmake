# The report, from made-up records: verdicts, summary, figures, page and PDF.
add_library(dem_synthetic STATIC reports/synthetic.cpp)
target_link_libraries(dem_synthetic PUBLIC dem_reports PRIVATE dem_texture dem_warnings)
target_compile_definitions(dem_synthetic PRIVATE DEM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")

dem_test(test_report_parts SOURCES reports/test_parts.cpp LIBRARIES dem_synthetic nlohmann_json::nlohmann_json)
dem_test(test_report_published SOURCES reports/test_published.cpp LIBRARIES dem_synthetic dem_lattice)
dem_test(test_report_fits SOURCES reports/test_fits.cpp LIBRARIES dem_reports)
dem_test(test_report_granite SOURCES reports/test_granite.cpp LIBRARIES dem_synthetic)
dem_test(test_report_workers SOURCES reports/test_workers.cpp LIBRARIES dem_synthetic)
dem_test(test_report_page SOURCES reports/test_page.cpp LIBRARIES dem_synthetic nlohmann_json::nlohmann_json)
add_library(dem_made_report STATIC reports/made_report.cpp)
target_link_libraries(dem_made_report PUBLIC dem_render PRIVATE dem_store nlohmann_json::nlohmann_json fmt::fmt dem_warnings)
dem_test(test_comparison SOURCES reports/test_comparison.cpp LIBRARIES dem_made_report dem_comparison dem_models)
