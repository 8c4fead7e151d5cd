# Usage requirement "warnings": what our own code is held to. Presets turn them into errors
# (CMAKE_COMPILE_WARNING_AS_ERROR); consumers of the installed package never see them.
add_library(warnings INTERFACE)
target_compile_options(warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wcast-qual
    $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast>)
