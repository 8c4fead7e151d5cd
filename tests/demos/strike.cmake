# A mesh of the user's: struck, heard, measured; what can't be is refused in a sentence.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)

must_succeed(strike ${mesh} --material steel --scale 0.05 --at 0,0,1 --hammer 0.01,0.01,0.5
             --seconds 0.5 --json - --quiet)
string(JSON stopped GET "${out}" stopped)
if(stopped)
    message(SEND_ERROR "it went unstable")
endif()
expect_between(40 150 peak_db_spl)
foreach(file strike.wav strike.png)
    if(NOT EXISTS ${work}/${file})
        message(SEND_ERROR "no ${file}")
    endif()
endforeach()
must_refuse("can't be read" strike ${mesh} --material steel --scale 0.05 --at 1,2 --quiet)
must_refuse("must be above 0" strike ${mesh} --material steel --scale 0.05 --hammer 0,1,1 --quiet)
must_refuse("no material" strike ${mesh} --scale 0.05 --quiet)
