# Compares the symbols a shared library exports with those the headers of a folder declare:
# cmake -D nm=... -D library=... -D headers=... -D mark=DSOFT_API -D interposed=... -P symbols.cmake
cmake_minimum_required(VERSION 3.25)
file(GLOB files ${headers}/*.h)
set(text "")
foreach(file IN LISTS files)
    file(READ ${file} part)
    string(APPEND text "${part}")
endforeach()
string(REGEX REPLACE "/[*]([^*]|[*]+[^*/])*[*]+/" "" text "${text}")
string(REGEX REPLACE "#[^\n]*" "" text "${text}")
string(REGEX MATCHALL "${mark}[^(]*[(]" declarations "${text}")
set(declared ${interposed})
foreach(declaration IN LISTS declarations)
    string(REGEX MATCH "([A-Za-z0-9_]+)[(]$" _ "${declaration}")
    list(APPEND declared ${CMAKE_MATCH_1})
endforeach()

execute_process(COMMAND ${nm} --dynamic --defined-only --demangle --format=posix ${library}
                OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" lines "${text}")
set(exported "")
foreach(line IN LISTS lines)
    # "name T address size"; a demangled name may hold spaces.
    if(line MATCHES "^(.*) [A-Za-z] [0-9a-f]+( [0-9a-f]+)?$")
        list(APPEND exported "${CMAKE_MATCH_1}")
    endif()
endforeach()

set(missing ${declared})
set(surplus ${exported})
list(REMOVE_ITEM missing ${exported})
list(REMOVE_ITEM surplus ${declared})
list(LENGTH declared count)
if(missing OR surplus)
    list(JOIN missing "\n  " missing)
    list(JOIN surplus "\n  " surplus)
    message(FATAL_ERROR "${library} and ${headers} disagree.\n"
                        "declared but not exported:\n  ${missing}\n"
                        "exported but not declared:\n  ${surplus}\n")
endif()
message(STATUS "${count} symbols, as declared")
