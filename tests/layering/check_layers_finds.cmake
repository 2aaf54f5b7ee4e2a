# SPDX-License-Identifier: BSD-3-Clause
# cmake -DSCRATCH=<folder> -P check_layers_finds.cmake
# check_layers.cmake must find each of these faults: a check that never complains proves nothing.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${SCRATCH}")
set(head "// SPDX-License-Identifier: BSD-3-Clause\n")

# <path> -> <contents, ~ for a new line> -> <part of the complaint>; no complaint is wanted where the last is empty
set(cases
  "include/pcl_gpf/core/a.h -> #pragma once~#include <Eigen/Core> -> core/a.h: must not include <Eigen/Core>"
  "include/pcl_gpf/core/b.h -> #pragma once~#include <pcl/point_types.h> -> must not include <pcl/point_types.h>"
  "include/pcl_gpf/core/c.h -> #include <vector> -> c.h: #pragma once is missing"
  "include/pcl_gpf/filters/d.h -> #pragma once~#include <pcl_gpf/surface/x.h> -> must not include <pcl_gpf/surface/x.h>"
  "include/pcl_gpf/filters/e.h -> #pragma once~#include \"../../../src/core/private.h\" -> must not include the private"
  "src/core/private.h -> #pragma once -> "
  "src/core/grid.cpp -> #include <oneapi/tbb/parallel_for.h> -> core/grid.cpp: must not include <oneapi/tbb/"
  "src/core/parallel.cpp -> #include <oneapi/tbb/parallel_for.h>~#include \"private.h\" -> "
  "src/core/operators/g.cpp -> #include <hwy/highway.h> -> operators/g.cpp: must not include <hwy/highway.h>"
  "src/core/kernels/k.cpp -> #include <hwy/highway.h> -> "
  "src/common/p.cpp -> void p() { std::cout << 1@ } -> common/p.cpp: the library must not print"
  "src/common/q.cpp -> int q() { return snprintf(nullptr, 0, \"\")@ } -> "
  "src/core/order.cpp -> auto o = std::partition(a, b, c)@ -> core/order.cpp: depends on the standard library"
  "src/core/stable.cpp -> auto o = std::stable_partition(a, b, c)@ -> "
  "src/core/draw.cpp -> std::normal_distribution<double> d@ -> core/draw.cpp: depends on the standard library"
  "tools/t.cpp -> #include \"core/private.h\" -> a tool must not include the private"
  "CMakeLists.txt -> add_compile_options(-march=native) -> no instruction set and no fast-math")
foreach(case IN LISTS cases)
  string(REGEX MATCH "^(.*) -> (.*) -> (.*)$" _ "${case}")
  set(path "${CMAKE_MATCH_1}")
  string(REPLACE "~" "\n" contents "${CMAKE_MATCH_2}")
  string(REPLACE "@" ";" contents "${contents}")
  if(path MATCHES "[.](h|cpp)$")
    string(PREPEND contents "${head}")
  endif()
  file(WRITE "${SCRATCH}/${path}" "${contents}\n")
endforeach()
file(WRITE "${SCRATCH}/tools/no_licence.cpp" "int x;\n")

execute_process(COMMAND "${CMAKE_COMMAND}" "-DROOT=${SCRATCH}" -P "${CMAKE_CURRENT_LIST_DIR}/check_layers.cmake"
  RESULT_VARIABLE status ERROR_VARIABLE log OUTPUT_VARIABLE log)
if(status EQUAL 0)
  message(FATAL_ERROR "The check found nothing.")
endif()
string(REGEX REPLACE "[ \n]+" " " log "${log}")
set(wanted "no_licence.cpp: the first line must be the SPDX licence line")
set(number_wanted 1)
foreach(case IN LISTS cases)
  string(REGEX MATCH "^(.*) -> (.*) -> (.*)$" _ "${case}")
  if(CMAKE_MATCH_3)
    list(APPEND wanted "${CMAKE_MATCH_3}")
  else()
    string(FIND "${log}" " ${CMAKE_MATCH_1}:" position)
    if(NOT position EQUAL -1)
      message(SEND_ERROR "False alarm about ${CMAKE_MATCH_1}: ${log}")
    endif()
  endif()
endforeach()
foreach(text IN LISTS wanted)
  string(FIND "${log}" "${text}" position)
  if(position EQUAL -1)
    message(SEND_ERROR "Not found: ${text}\nThe check said: ${log}")
  endif()
endforeach()
