# Rigid bodies that sound: a xylophone, dice and coins, a marble, by the figures that they write.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)

# Each bar is struck, and in tune with Timoshenko's free bar within the mark of 3 cents.
demo(xylophone)
foreach(bar RANGE 7)
    expect_between(1 10 bodies ${bar} blows)
    expect_between(-3 3 bodies ${bar} cents)
endforeach()

# Kirchhoff's free disc knows no shear: a real coin, 17 times as wide as thick, lies under it, by less
# than a semitone. A die of 15 mm clicks: its lowest mode is at the end of hearing.
demo(dice)
expect_between(-100 0 bodies 2 cents)
expect_between(15000 22000 bodies 0 lowest)

# What rolls over waves sounds at its speed over their length: the window tells 3 Hz. At rest it is mute.
demo(marble)
string(JSON expected GET "${out}" figures line_expected_hz)
string(REGEX REPLACE "[.].*" "" expected_hz "${expected}")
math(EXPR low "${expected_hz} - 3")
math(EXPR high "${expected_hz} + 4")
expect_between(${low} ${high} figures line_hz)
expect_between(0 0 figures rms_at_the_end)
