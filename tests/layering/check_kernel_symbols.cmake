# SPDX-License-Identifier: BSD-3-Clause
# cmake -DOBJECTS=<list of object files> -DNM=<nm> -DOBJDUMP=<objdump> -P check_kernel_symbols.cmake
# A weak symbol (a template or inline function) of a kernel's object may be the copy that the linker gives to the whole
# program. So none may hold AVX code, except those in Highway's namespaces, one for each instruction set (N_AVX2, ...).
cmake_minimum_required(VERSION 3.25)
file(STRINGS "${OBJECTS}" objects REGEX "/kernels/.*[.]o$")
if(NOT objects)
  message(FATAL_ERROR "There is no object of a kernel in ${OBJECTS}.")
endif()
# The disassemblers of GNU and of LLVM name the option for one function differently.
execute_process(COMMAND "${OBJDUMP}" --version OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
set(one_symbol --disassemble)
if(version MATCHES "LLVM")
  set(one_symbol --disassemble-symbols)
endif()
set(checked 0)
foreach(object IN LISTS objects)
  get_filename_component(name "${object}" NAME)
  execute_process(COMMAND "${NM}" "${object}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[0-9a-f]+ W [^\n]+" weak "${symbols}")
  list(TRANSFORM weak REPLACE "^[0-9a-f]+ W " "")
  list(FILTER weak EXCLUDE REGEX "[0-9]N_[A-Z]")
  foreach(symbol IN LISTS weak)
    execute_process(COMMAND "${OBJDUMP}" --no-show-raw-insn "${one_symbol}=${symbol}" "${object}"
      OUTPUT_VARIABLE code COMMAND_ERROR_IS_FATAL ANY)
    math(EXPR checked "${checked} + 1")
    if(code MATCHES "\tv[a-z0-9]+[ \t]+[^\n]*%[xyz]mm")
      message(SEND_ERROR "${name}: the shared symbol ${symbol} has AVX code")
    endif()
  endforeach()
endforeach()
list(LENGTH objects number)
message(STATUS "${number} kernel objects, ${checked} shared symbols, none with AVX code")
