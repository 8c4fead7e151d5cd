# One step of the package test:
# cmake -D step=install|cmake|pkgconfig|preload|late -D build=... -D source=... -D work=... -D libdir=...
#       -D cc=... -D generator=... -P consume.cmake
cmake_minimum_required(VERSION 3.25)
set(prefix ${work}/moved)
set(libraries ${prefix}/${libdir})

# Runs a command in a directory; a failure shows what it said.
function(run directory)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${directory} RESULT_VARIABLE status
                    OUTPUT_VARIABLE said ERROR_VARIABLE said)
    if(status)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\nfailed (${status}):\n${said}")
    endif()
    set(said "${said}" PARENT_SCOPE)
endfunction()

# Writes the first fenced block of a language in README.md to a file.
function(readme_block language file)
    file(READ ${source}/README.md text)
    string(FIND "${text}" "```${language}\n" start)
    if(start EQUAL -1)
        message(FATAL_ERROR "README.md has no block of ${language}")
    endif()
    string(LENGTH "```${language}\n" skip)
    math(EXPR start "${start} + ${skip}")
    string(SUBSTRING "${text}" ${start} -1 text)
    string(FIND "${text}" "\n```" end)
    string(SUBSTRING "${text}" 0 ${end} text)
    file(WRITE ${file} "${text}\n")
endfunction()

# Runs the program of README.md, which must leave a second of stereo float at 48 kHz in clang.wav:
# closed properly, and not silent half a second in, when the bowl has landed.
function(must_sound directory program)
    set(wav ${directory}/clang.wav)
    file(REMOVE ${wav})
    run(${directory} ${program})
    if(NOT EXISTS ${wav})
        message(FATAL_ERROR "${program} left no clang.wav; it said:\n${said}")
    endif()
    file(SIZE ${wav} size)
    if(size LESS 384000)
        message(FATAL_ERROR "clang.wav holds ${size} bytes, less than a second of sound")
    endif()
    file(READ ${wav} riff OFFSET 4 LIMIT 4 HEX)
    string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1" riff ${riff})
    math(EXPR riff "${riff} + 8")
    if(NOT riff EQUAL size)
        message(FATAL_ERROR "clang.wav says it holds ${riff} bytes and holds ${size}")
    endif()
    file(READ ${wav} samples OFFSET 200000 LIMIT 50000 HEX)
    if(samples MATCHES "^0*$")
        message(FATAL_ERROR "clang.wav is silent after half a second")
    endif()
endfunction()

set(compile ${cc} -std=c99 -Wall -Wextra -Werror)
file(REMOVE_RECURSE ${work}/${step})
file(MAKE_DIRECTORY ${work}/${step})
if(step STREQUAL "install")
    file(REMOVE_RECURSE ${prefix})
    run(${work} ${CMAKE_COMMAND} --install ${build} --prefix ${work}/install/tree)
    file(RENAME ${work}/install/tree ${prefix})
elseif(step STREQUAL "cmake")
    readme_block(c ${work}/cmake/clang.c)
    readme_block(cmake ${work}/cmake/CMakeLists.txt)
    run(${work}/cmake ${CMAKE_COMMAND} -G ${generator} -S . -B build -D CMAKE_PREFIX_PATH=${prefix}
        -D CMAKE_C_COMPILER=${cc})
    run(${work}/cmake ${CMAKE_COMMAND} --build build)
    must_sound(${work}/cmake build/clang)
elseif(step STREQUAL "pkgconfig")
    set(ENV{PKG_CONFIG_PATH} ${libraries}/pkgconfig)
    run(${work} pkg-config --cflags --libs ode_sound)
    string(STRIP "${said}" flags)
    separate_arguments(flags UNIX_COMMAND "${flags}")
    list(APPEND flags -Wl,-rpath,${libraries})
    readme_block(c ${work}/pkgconfig/clang.c)
    run(${work}/pkgconfig ${compile} clang.c -o clang ${flags})
    must_sound(${work}/pkgconfig ./clang)
    run(${work}/pkgconfig ${compile} ${source}/tests/package/hook.c -o hook ${flags} -ldl -lm)
    run(${work}/pkgconfig ./hook interposed)
elseif(step STREQUAL "preload")
    # ODE comes first on the link line, so its own dWorldStep would win.
    run(${work}/preload ${compile} ${source}/tests/package/hook.c -o hook -I${prefix}/include
        -lode -Wl,--no-as-needed -L${libraries} -lode_softbody -Wl,-rpath,${libraries} -ldl -lm)
    run(${work}/preload ${CMAKE_COMMAND} -E env LD_PRELOAD=${libraries}/libode_softbody.so
        ./hook interposed)
    run(${work}/preload ./hook threading) # the wrong order works, too
elseif(step STREQUAL "late")
    # The program knows ODE alone; the library is opened while the world runs.
    foreach(binding lazy now)
        run(${work}/late ${compile} ${source}/tests/package/hook.c -o hook_${binding}
            -I${prefix}/include -Wl,-z,${binding} -lode -ldl -lm)
        run(${work}/late ./hook_${binding} threading ${libraries}/libode_softbody.so)
        run(${work}/late ./hook_${binding} threading_global ${libraries}/libode_softbody.so)
    endforeach()
endif()
