# Each mistake gets a status and a sentence, and leaves no file behind.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)

must_refuse("A subcommand is required")
must_refuse("no scene 'gong'; there are: bowl" demo gong)
must_refuse("name a scene" demo)
must_refuse("--seconds" demo bowl --seconds -1)
must_refuse("--tier" demo bowl --tier magic)
must_refuse("unobtainium" demo bowl --material unobtainium)
must_refuse("absent.msh" demo bowl --mesh absent.msh)
must_refuse("absent.msh" inspect absent.msh)
must_refuse("MESH|mesh" inspect)
must_refuse("nowhere" demo bowl --seconds 0.01 --out nowhere/bowl.wav)

file(GLOB left ${work}/*)
if(left)
    message(SEND_ERROR "a refused command left ${left}")
endif()
