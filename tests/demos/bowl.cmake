# The demo of the bowl up to just after its first impact.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)

must_succeed(demo bowl --seconds 0.42 --quiet)
file(READ ${work}/bowl.json out)
expect_between(434 434 nodes)
expect_between(1152 1152 elements)
# 2 pi/3 (R^3 - (R - t)^3) rho = 2.345 kg in steel; eight rings of flat facets lose about 1 %.
expect_between(2.29 2.346 mass)
# sqrt(2 h / g) = 0.3193 s of free fall; a substep's granularity is below a microsecond.
expect_between(0.3190 0.3196 impacts 0)
# It strikes at 3 m/s: louder than speech (60 dB), and no explosion (its ring decays).
expect_between(70 150 peak_db_spl)
expect_between(0.0001 0.5 audio_share)
expect_between(0.4199 0.4241 seconds)
string(JSON stopped GET "${out}" stopped)
if(stopped)
    message(SEND_ERROR "the bowl went unstable")
endif()
foreach(file bowl.wav bowl.png)
    if(NOT EXISTS ${work}/${file})
        message(SEND_ERROR "no ${file}")
    endif()
endforeach()
file(SIZE ${work}/bowl.png size)
if(size GREATER 100000)
    message(SEND_ERROR "bowl.png takes ${size} bytes, more than 100 kB")
endif()

must_succeed(demo bowl --help)
expect_says("${out}" "sqrt(2 h / g)")
