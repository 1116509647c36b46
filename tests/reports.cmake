# The report, from made-up records: verdicts, summary, figures, page and PDF.
add_library(dem_synthetic STATIC reports/synthetic.cpp)
target_link_libraries(dem_synthetic PUBLIC dem_reports PRIVATE dem_warnings)
target_include_directories(dem_synthetic PUBLIC ${PROJECT_SOURCE_DIR})

dem_test(test_report_page SOURCES reports/test_page.cpp LIBRARIES dem_synthetic)
