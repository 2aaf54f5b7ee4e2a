# SPDX-License-Identifier: BSD-3-Clause
# cmake -DMODULE=<pkg-config module> -DSOURCE=<file> -DCXX=<compiler> -DPREFIX=<prefix> -DLIBDIR=<lib> -DWORK=<folder>
#       [-DFLAGS=<list>] [-DREFUSED=<regular expression>] -P pkg_config.cmake
# Builds and runs a program with the compiler and pkg-config alone. With REFUSED, the compiler must stop with that text.
cmake_minimum_required(VERSION 3.25)
set(ENV{PKG_CONFIG_PATH} "${PREFIX}/${LIBDIR}/pkgconfig")
find_program(pkg_config NAMES pkg-config pkgconf REQUIRED)
execute_process(COMMAND "${pkg_config}" --cflags --libs "${MODULE}"
  OUTPUT_VARIABLE module_flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(module_flags UNIX_COMMAND "${module_flags}")
file(MAKE_DIRECTORY "${WORK}")

if(REFUSED)
  list(APPEND FLAGS -Wfatal-errors) # the refusal is the first error; there is no need to read on
endif()
execute_process(
  COMMAND "${CXX}" -std=c++17 -O1 ${FLAGS} "${SOURCE}" -o "${WORK}/consumer" ${module_flags}
    "-Wl,-rpath,${PREFIX}/${LIBDIR}"
  RESULT_VARIABLE status OUTPUT_VARIABLE log ERROR_VARIABLE log)
if(REFUSED)
  if(status EQUAL 0)
    message(FATAL_ERROR "The compiler should have refused ${FLAGS}.")
  elseif(NOT log MATCHES "${REFUSED}")
    message(FATAL_ERROR "The refusal does not say '${REFUSED}':\n${log}")
  endif()
  return()
endif()
if(NOT status EQUAL 0)
  message(FATAL_ERROR "It does not build:\n${log}")
endif()
execute_process(COMMAND "${WORK}/consumer" COMMAND_ERROR_IS_FATAL ANY)
