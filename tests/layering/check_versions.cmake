# SPDX-License-Identifier: BSD-3-Clause
# cmake -DROOT=<project> -DVERSION=<of version.h> -P check_versions.cmake
cmake_minimum_required(VERSION 3.25)
file(STRINGS "${ROOT}/package.xml" package REGEX "<version>")
if(NOT package MATCHES "<version>${VERSION}</version>")
  message(SEND_ERROR "package.xml has ${package}, version.h has ${VERSION}.")
endif()
file(STRINGS "${ROOT}/CHANGELOG.md" newest REGEX "^## \\[[0-9]" LIMIT_COUNT 1)
string(FIND "${newest}" "## [${VERSION}]" position)
if(NOT position EQUAL 0)
  message(SEND_ERROR "The newest entry of CHANGELOG.md is '${newest}', version.h has ${VERSION}.")
endif()
