# Checks or cures the formatting of every source file:
# cmake -D clang_format=PROGRAM -D mode=check|cure -P cmake/format.cmake
cmake_minimum_required(VERSION 3.25)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
set(files "")
foreach(folder ode_softbody sound bindings demos tests)
    file(GLOB_RECURSE found ${root}/${folder}/*.h ${root}/${folder}/*.hpp ${root}/${folder}/*.c
         ${root}/${folder}/*.cpp)
    list(APPEND files ${found})
endforeach()
if(mode STREQUAL "cure")
    execute_process(COMMAND ${clang_format} -i ${files} COMMAND_ERROR_IS_FATAL ANY)
    return()
endif()
execute_process(COMMAND ${clang_format} --dry-run --Werror --ferror-limit=1 ${files}
                RESULT_VARIABLE status ERROR_VARIABLE complaints)
if(status)
    string(REGEX MATCHALL "[^\n]*error:[^\n]*" complaints "${complaints}")
    list(JOIN complaints "\n  " complaints)
    message(FATAL_ERROR "not formatted (cure: cmake --build build/release --target format):\n"
                        "  ${complaints}")
endif()
