# The demo of the bowl, five impacts, in three materials.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)

must_succeed(demo bowl --quiet)
file(READ ${work}/bowl.json out)
expect_between(434 434 nodes)
expect_between(1152 1152 elements)
# 2 pi/3 (R^3 - (R - t)^3) rho = 2.345 kg in steel; eight rings of flat facets lose about 1 %.
expect_between(2.29 2.346 mass)
# sqrt(2 h / g) = 0.3193 s of free fall; a substep's granularity is below a microsecond.
expect_between(0.3190 0.3196 impacts 0)
# It strikes at 3 m/s: louder than speech (60 dB), and no explosion (its ring decays).
expect_between(70 150 peak_db_spl)
# A share, and not none: how large is for the benchmarks to tell.
expect_between(0.0001 1 audio_share)
expect_between(2 2 seconds)
# The same lines after each of five impacts, weighed anew. They differ by the body's speed alone: v / c is
# 15.8 cents after a fall of half a metre; 2 for a window of 40 ms.
string(JSON rows LENGTH "${out}" impact_lines levels_db)
if(NOT rows EQUAL 5)
    message(SEND_ERROR "lines after ${rows} impacts instead of 5")
endif()
expect_between(0 17.8 impact_lines drift_cents)
expect_between(6 60 impact_lines reweighted_db)
expect_between(-5 5 partials 0 cents)
expect_between(-5 5 partials 1 cents)
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

# Glass and wood: pitch by sqrt(E / rho) (Poisson's ratio is worth a per cent), decay by their damping.
foreach(material glass wood)
    must_succeed(demo bowl-${material} --quiet)
    file(READ ${work}/bowl-${material}.json out)
    expect_between(0.3190 0.3196 impacts 0)
    expect_between(-8 8 partials 0 cents)
    if(material STREQUAL "glass") # sqrt(62 / 2600 * 7850 / 200) = 0.9674: 1921 Hz of 1986
        expect_between(1900 1980 partials 0 measured)
        expect_between(0.8 0.9 t60_of_lowest)
    else() # sqrt(11 / 750 * 7850 / 200) = 0.7587: 1507 Hz
        expect_between(1480 1540 partials 0 measured)
        expect_between(0.05 0.065 t60_of_lowest)
    endif()
endforeach()

must_succeed(demo bowl --help)
expect_says("${out}" "sqrt(2 h / g)")
