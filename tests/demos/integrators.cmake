# The table of integrators: what is read off their code is what theory says of them.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)

must_succeed(integrators --quiet --json - --plot response.png --csv response.csv)
# The first point is w h = 0.01: |z| of explicit Euler sqrt(1.0001), of backward Euler its inverse.
expect_between(1.00004999 1.00005000 integrators explicit-euler amplification 0)
expect_between(0.99995000 0.99995001 integrators backward-euler amplification 0)
expect_between(0.999999999 1.000000001 integrators trapezoidal amplification 240)
expect_between(2 2 integrators tr-bdf2 order)
foreach(file response.png response.csv)
    if(NOT EXISTS ${work}/${file})
        message(SEND_ERROR "${file} was not written")
    endif()
endforeach()

must_succeed(integrators --damping-ratio 0.1)
expect_says("${out}" "runge-kutta-4")
must_refuse("--damping-ratio" integrators --damping-ratio -1)
must_refuse("nowhere/response.csv" integrators --csv nowhere/response.csv)
