# Pitches as scripts read them: closed forms within the band that is claimed, and every refusal.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)
set(ENV{ODE_SOFTBODY_CACHE} "")

# A Gmsh 2.2 block of nx ny nz cells of dx dy dz units, six tetrahedra each (Kuhn); the half
# beyond x = nx/2 is the physical group "tip", the other "root".
function(write_block file nx ny nz dx dy dz)
    math(EXPR row "${nz} + 1")
    math(EXPR slab "(${ny} + 1) * ${row}")
    math(EXPR count "(${nx} + 1) * ${slab}")
    set(text "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"root\"\n3 2 \"tip\"\n")
    string(APPEND text "$EndPhysicalNames\n$Nodes\n${count}\n")
    foreach(i RANGE ${nx})
        foreach(j RANGE ${ny})
            foreach(k RANGE ${nz})
                math(EXPR n "1 + ${i} * ${slab} + ${j} * ${row} + ${k}")
                math(EXPR x "${i} * ${dx}")
                math(EXPR y "${j} * ${dy}")
                math(EXPR z "${k} * ${dz}")
                string(APPEND text "${n} ${x} ${y} ${z}\n")
            endforeach()
        endforeach()
    endforeach()
    math(EXPR count "6 * ${nx} * ${ny} * ${nz}")
    string(APPEND text "$EndNodes\n$Elements\n${count}\n")
    set(e 0)
    math(EXPR last_x "${nx} - 1")
    math(EXPR last_y "${ny} - 1")
    math(EXPR last_z "${nz} - 1")
    foreach(i RANGE ${last_x})
        math(EXPR group "1 + 2 * ${i} / ${nx}")
        foreach(j RANGE ${last_y})
            foreach(k RANGE ${last_z})
                math(EXPR a "1 + ${i} * ${slab} + ${j} * ${row} + ${k}")
                math(EXPR d "${a} + ${slab} + ${row} + 1")
                # Two middle corners of each tetrahedron along a path from a to d.
                foreach(path "${slab} ${slab}+${row}" "${row} ${row}+1" "1 1+${slab}"
                             "${slab}+1 ${slab}" "${row}+${slab} ${row}" "1+${row} 1")
                    string(REPLACE " " ";" path "${path}")
                    list(GET path 0 b)
                    list(GET path 1 c)
                    math(EXPR b "${a} + ${b}")
                    math(EXPR c "${a} + ${c}")
                    math(EXPR e "${e} + 1")
                    string(APPEND text "${e} 4 2 ${group} 1 ${a} ${b} ${c} ${d}\n")
                endforeach()
            endforeach()
        endforeach()
    endforeach()
    file(WRITE ${work}/${file} "${text}$EndElements\n")
endfunction()

write_block(bar.msh 16 2 1 18750 10000 10000)    # micrometres: 0.3 x 0.02 x 0.01 m
write_block(plate.msh 8 8 1 25 25 1)             # of 0.05 m: NAFEMS FV12, 10 x 10 x 0.05 m
set(aluminium --young 69e9 --poisson 0.33 --density 2700)
set(bar bar.msh --scale 1e-6)

# Case A1: Euler-Bernoulli gives 90.70 and 181.4 Hz (thin and wide bending), 568.4 the second thin
# one. A solid clamp is some 7 cents stiffer (0.4 %); the coarse mesh's band is 6 and 4 cents.
must_succeed(modes ${bar} ${aluminium} --clamp "x<1e-6" --count 3 --json - --quiet)
expect_between(102 102 nodes)
expect_between(192 192 elements)
expect_between(0.161999 0.162001 mass)
expect_between(5.99999e-5 6.00001e-5 volume)
expect_between(0.00122039 0.00122041 inertia 2 2) # m (L^2 + b^2) / 12
expect_between(90.6 91.6 frequencies 0)
expect_between(180.4 182.3 frequencies 1)
expect_between(565.0 571.0 frequencies 2)
expect_between(0.02 15 error_cents 0)
string(JSON count LENGTH "${out}" frequencies)
if(NOT count EQUAL 3 OR NOT err STREQUAL "")
    message(SEND_ERROR "${count} frequencies of 3, or --quiet speaks:\n${err}")
endif()

# Asked for a tolerance, it keeps it; the nodes it tells are still the file's.
must_succeed(modes ${bar} ${aluminium} --clamp "x<1e-6" --count 2 --tolerance 4 --json -)
expect_between(102 102 nodes)
expect_between(0 4 error_cents 0)
expect_between(0 4 error_cents 1)
expect_between(90.6 91.4 frequencies 0)

# Or says by how much it can't.
must_refuse("estimated error is .* cents, 0.01 asked for" modes ${bar} ${aluminium} --clamp "x<1e-6"
            --count 2 --tolerance 0.01 --max-nodes 5000)

# Case A4, NAFEMS FV12: 1.622, 2.360, 2.922 Hz. Free: the six rigid modes are left out.
must_succeed(modes plate.msh --scale 0.05 --material 200e9:0.3:8000 --count 3 --json - --quiet)
expect_between(39999 40001 mass)
expect_between(1.60 1.645 frequencies 0)
expect_between(2.335 2.385 frequencies 1)
expect_between(2.89 2.955 frequencies 2)

# Linear elements are octaves sharp on a plate this thin, and their band says so.
must_succeed(modes plate.msh --scale 0.05 --material 200e9:0.3:8000 --order 1 --mass lumped
             --count 1 --json - --quiet)
expect_between(3.2 100 frequencies 0)
expect_between(1200 20000 error_cents 0)

# Materials by group: a tip of twice the density is as heavy as it should be.
must_succeed(modes ${bar} --material root=69e9:0.33:2700 --material tip=69e9:0.33:5400 --count 1
             --json out.json)
expect_says("${out}" "frequency [Hz]")
file(READ ${work}/out.json out)
expect_between(0.242999 0.243001 mass)

must_succeed(modes --help)
expect_says("${out}" "cents (1200 an")

set(steel --material steel)
must_refuse("'x<-1' catches no node: in this mesh x runs from 0 to 0.3 m" modes ${bar} ${steel}
            --clamp "x<-1")
must_refuse("can't be read" modes ${bar} ${steel} --clamp "w<1")
must_refuse("holds all" modes ${bar} ${steel} --clamp "x<1")
must_refuse("Poisson's ratio .*is 0.5" modes ${bar} --young 1e9 --poisson 0.5 --density 1000)
must_refuse("density .*is 0 " modes ${bar} --young 1e9 --poisson 0.3 --density 0)
must_refuse("density .*is -1 kg" modes ${bar} --young 1e9 --poisson 0.3 --density -1)
must_refuse("density .*is nan" modes ${bar} --young 1e9 --poisson 0.3 --density nan)
must_refuse("Young's modulus .*is -1e.09 Pa" modes ${bar} --young -1e9 --poisson 0.3 --density 1000)
must_refuse("Poisson's ratio .*is 0.6" modes ${bar} --material 1e9:0.6:1000)
must_refuse("Poisson's ratio .*is -1" modes ${bar} --material 1e9:-1:1000)
must_refuse("of group 'tip' is 0 Pa" modes ${bar} ${steel} --material tip=0:0.3:1000)
must_refuse("belong together" modes ${bar} --young 1e9 --poisson 0.3)
must_refuse("no physical group 'head'; there are: root, tip" modes ${bar} ${steel}
            --material head=steel)
must_refuse("no material for the physical group 'tip'" modes ${bar} --material root=steel)
must_refuse("unobtainium" modes ${bar} --material unobtainium)
must_refuse("three numbers" modes ${bar} --material 2e11:0.3)
must_refuse("millimetres taken for metres" modes bar.msh ${steel})
must_refuse("absent.msh" modes absent.msh ${steel})
must_refuse("no material" modes ${bar})
must_refuse("--count" modes ${bar} ${steel} --count 0)
must_refuse("--count" modes ${bar} ${steel} --count -3)
foreach(option --tolerance --scale --max-frequency)
    foreach(value 0 -1 nan inf)
        must_refuse("${option}.* '${value}' must be a finite number above 0" modes ${bar} ${steel}
                    ${option} ${value})
    endforeach()
endforeach()
must_refuse("--order" modes ${bar} ${steel} --order 4)
softsound(modes ${bar} ${steel} --clamp "x<-1" --json -)
if(NOT status EQUAL 1 OR NOT out STREQUAL "")
    message(SEND_ERROR "a refusal ends with ${status}, not 1, or leaves data:\n${out}")
endif()

# The form that scripts rely on: these keys, in this order, and nothing else on standard output.
must_succeed(modes ${bar} ${steel} --count 1 --json -)
string(JSON length LENGTH "${out}")
set(keys "")
math(EXPR last "${length} - 1")
foreach(i RANGE ${last})
    string(JSON key MEMBER "${out}" ${i})
    list(APPEND keys ${key})
endforeach()
list(SORT keys)
if(NOT keys STREQUAL "elements;error_cents;frequencies;inertia;mass;nodes;seconds;volume")
    message(SEND_ERROR "the keys are ${keys}")
endif()
if(NOT out MATCHES "^{[^}]*}\n$")
    message(SEND_ERROR "standard output is more than one JSON object:\n${out}")
endif()

# Clamps are a union: a bar held at both ends, 4.73^2 / 1.875^2 = 6.36 times as high as at one.
must_succeed(modes ${bar} ${aluminium} --clamp "x<1e-6" --clamp "x>0.2999" --count 1 --json - --quiet)
expect_between(570 585 frequencies 0)

# T60 by the preset's damping, ln(1000) / d; none where only numbers are given.
must_succeed(modes ${bar} ${steel} --count 1)
expect_says("${out}" "T60 [s]")
must_succeed(modes ${bar} ${aluminium} --count 1)
if(NOT out MATCHES "\n +1 +[0-9.]+ +[+]-[0-9.]+ +-\n")
    message(SEND_ERROR "numbers without damping have a T60:\n${out}")
endif()

# 20 m: not refused, as 300 m is, but asked about.
must_succeed(modes ${bar} ${steel} --count 1 --json -)
must_succeed(modes bar.msh --scale 6e-5 ${steel} --count 1 --json -)
if(err MATCHES "millimetres")
    message(SEND_ERROR "a scale that was given is doubted:\n${err}")
endif()
write_block(long.msh 6 1 1 3 1 1)
must_succeed(modes long.msh ${steel} --count 1 --json -)
expect_says("${err}" "18 m long: millimetres taken for metres")
