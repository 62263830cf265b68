# cmake --install BUILD [--prefix DIR]: the program with manual pages, completion, documentation,
# examples, the Python package and the JSON Schema of the job file. cpack --config BUILD/CPackConfig.cmake: a .deb of
# these. Templates are part of the program.
include(GNUInstallDirs)
install(TARGETS frictab RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# Pages and scripts that the program writes about itself on installation.
set(FRICTAB_PAGES ${CMAKE_BINARY_DIR}/pages)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:frictab> \
-DPAGES=${FRICTAB_PAGES} -P ${CMAKE_CURRENT_LIST_DIR}/pages.cmake COMMAND_ERROR_IS_FATAL ANY)")
install(DIRECTORY ${FRICTAB_PAGES}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${FRICTAB_PAGES}/frictab DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${FRICTAB_PAGES}/_frictab DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${FRICTAB_PAGES}/frictab.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES ${FRICTAB_PAGES}/job.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/frictab)

install(FILES README.md CHANGELOG.md SECURITY.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
        PATTERN data EXCLUDE PATTERN out EXCLUDE PATTERN __pycache__ EXCLUDE
        REGEX "/examples/run$" EXCLUDE) # that script builds the program

# Debian's python3 looks there if the prefix is /usr, as in the .deb; others set PYTHONPATH or use pip.
set(FRICTAB_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Folder of the Python package")
install(DIRECTORY python/frictab DESTINATION ${FRICTAB_PYTHON_DIR} PATTERN __pycache__ EXCLUDE)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # the files to pack are built already
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME frictab)
set(CPACK_PACKAGE_CONTACT "The frictab authors") # as CITATION.cff; the project has no address
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "friction laws: tribometer data to FE subroutine")
set(CPACK_PACKAGE_DESCRIPTION "Calibrates friction laws on tribometer data, tabulates them, writes \
friction subroutines for finite-element codes and proves how far these are from the law.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# verify compiles what was generated, the Python package tables of many rows.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gcc, gfortran, libc6-dev, python3-h5py, python3-pandas")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "clang, luajit, lua5.4, python3-matplotlib, python3-xarray")
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME frictab-${PROJECT_VERSION})
set(CPACK_SOURCE_IGNORE_FILES "/\\\\.git/" "/build/" "/__pycache__/" "/out/")
include(CPack)
