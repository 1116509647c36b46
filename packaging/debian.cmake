# A package for Debian 12: cpack -G DEB in the build folder. tests/package/run tries it on a bare system.
set(DEM_MAINTAINER "The dem-report authors <authors@dem-report.invalid>" CACHE STRING
    "Who answers for the package: name and address, as Debian writes them")

execute_process(COMMAND date -u -d ${DEM_DATE} "+%a, %d %b %Y 00:00:00 +0000" OUTPUT_VARIABLE DEM_CHANGELOG_DATE
                OUTPUT_STRIP_TRAILING_WHITESPACE)
set(kept ${PROJECT_BINARY_DIR}/packaging)
configure_file(packaging/changelog.in ${kept}/changelog @ONLY)
configure_file(CHANGELOG.md ${kept}/CHANGELOG.md COPYONLY)
execute_process(COMMAND gzip -9nkf ${kept}/changelog ${kept}/CHANGELOG.md)
install(FILES packaging/copyright ${kept}/changelog.gz ${kept}/CHANGELOG.md.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/use docs/notes docs/papers DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dem-report)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "${DEM_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "discrete element studies of brittle rock, from scenario to report")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Simulates the cases of a scenario file and reports them in HTML and PDF:
crack maps, stress-strain and energy plots, published numbers beside ours.
Three models: a grain texture model of granite, a close-packed lattice, and
a sheet of springs on grown grains. Compares reports with references, night
by night.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${kept})
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/permissions.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What it starts or opens by itself: shlibdeps sees the libraries alone.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "weasyprint, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "slurm-client, bash-completion")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
