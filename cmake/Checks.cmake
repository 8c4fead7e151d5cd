# The rules of the house as tests: layers, and formatting where clang-format-14 is at hand (newer
# versions format differently). `cmake --build build/release --target format` cures the latter.
add_test(NAME house.layers COMMAND ${CMAKE_COMMAND} -P ${PROJECT_SOURCE_DIR}/cmake/layers.cmake)
set_tests_properties(house.layers PROPERTIES LABELS unit TIMEOUT 10)

find_program(CLANG_FORMAT clang-format-14)
mark_as_advanced(CLANG_FORMAT)
if(CLANG_FORMAT)
    add_test(NAME house.format
             COMMAND ${CMAKE_COMMAND} -D clang_format=${CLANG_FORMAT} -D mode=check
                     -P ${PROJECT_SOURCE_DIR}/cmake/format.cmake)
    set_tests_properties(house.format PROPERTIES LABELS unit TIMEOUT 60)
    add_custom_target(format
        COMMAND ${CMAKE_COMMAND} -D clang_format=${CLANG_FORMAT} -D mode=cure
                -P ${PROJECT_SOURCE_DIR}/cmake/format.cmake)
else()
    message(STATUS "clang-format-14 is not installed: formatting stays unchecked")
endif()
