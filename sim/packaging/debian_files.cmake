# Between installing and packing: what a Debian package has elsewhere or otherwise. Run by CPack.
if(CPACK_GENERATOR STREQUAL "DEB")
  set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
  file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
  file(REMOVE ${share}/doc/cosys-sim/LICENSE)  # every Debian has it, in common-licenses
  execute_process(COMMAND gzip -9n ${share}/man/man1/cosys-sim.1 ${share}/doc/cosys-sim/CHANGELOG.md
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
