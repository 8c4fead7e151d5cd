# What the tests of the command line share. Each runs in a folder of its own, made anew.
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})

# Runs softsound; sets `status`, `out` and `err`.
macro(softsound)
    execute_process(COMMAND ${softsound} ${ARGN} WORKING_DIRECTORY ${work} RESULT_VARIABLE status
                    OUTPUT_VARIABLE out ERROR_VARIABLE err)
endmacro()

macro(must_succeed)
    softsound(${ARGN})
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "softsound ${ARGN}\nended with ${status}:\n${out}${err}")
    endif()
endmacro()

# Fails with a sentence that holds `words`, and without a crash.
macro(must_refuse words)
    softsound(${ARGN})
    if(NOT status MATCHES "^[1-9][0-9]*$")
        message(FATAL_ERROR "softsound ${ARGN}\nended with ${status} instead of refusing:\n${out}${err}")
    elseif(NOT "${out}${err}" MATCHES "${words}")
        message(FATAL_ERROR "softsound ${ARGN}\nnever said '${words}':\n${out}${err}")
    endif()
endmacro()

# A number of the JSON in `out`, by its keys, must lie in low..high.
macro(expect_between low high)
    string(JSON value GET "${out}" ${ARGN})
    if(value LESS ${low} OR value GREATER ${high})
        message(SEND_ERROR "${ARGN} is ${value}, expected ${low} to ${high}")
    endif()
endmacro()

function(expect_says text words)
    string(FIND "${text}" "${words}" at)
    if(at EQUAL -1)
        message(SEND_ERROR "expected '${words}' in:\n${text}")
    endif()
endfunction()

# Runs a demo that leaves sound, picture and figures; `out` becomes these.
function(demo name)
    must_succeed(demo ${name} --quiet ${ARGN})
    file(READ ${work}/${name}.json out)
    set(out "${out}" PARENT_SCOPE)
    foreach(file ${name}.wav ${name}.png)
        if(NOT EXISTS ${work}/${file})
            message(SEND_ERROR "no ${file}")
        endif()
    endforeach()
    file(SIZE ${work}/${name}.png size)
    if(size GREATER 100000)
        message(SEND_ERROR "${name}.png takes ${size} bytes, more than 100 kB")
    endif()
endfunction()
