# Files that "cmake --install" installs in addition to the programs: man pages, the licence, and an example
# configuration with simulated axes that mdofd runs unchanged. (Each folder installs its programs, units and rules.)
install(FILES tools/mdof/mdof.1 tools/mdof_simulate/mdof-simulate.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES daemon/mdofd.toml.5 DESTINATION ${CMAKE_INSTALL_MANDIR}/man5)
install(FILES tools/mdof/mdof-fields.7 DESTINATION ${CMAKE_INSTALL_MANDIR}/man7)
install(FILES daemon/mdofd.8 DESTINATION ${CMAKE_INSTALL_MANDIR}/man8)
install(FILES README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES drivers/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME drivers.md)
install(FILES schema/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME schema.md)
install(FILES tools/mdof_simulate/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME mdof-simulate.md)
install(DIRECTORY daemon/examples/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)
install(FILES tools/mdof_simulate/example.toml DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples
        RENAME mdof-simulate.toml)
