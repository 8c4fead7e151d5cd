# Units and numbers of a mesh: one tetrahedron with right-angled edges of 240 units.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/command.cmake)
file(WRITE ${work}/corner.mesh "MeshVersionFormatted 2
Dimension 3
Vertices
4
0 0 0 0
240 0 0 0
0 240 0 0
0 0 240 0
Tetrahedra
1
1 2 3 4 0
End
")

must_succeed(inspect corner.mesh --quiet --json -)
expect_between(4 4 nodes)
expect_between(1 1 elements)
expect_between(4 4 surface_triangles)
expect_between(2303999.99 2304000.01 volume) # 240^3 / 6
expect_between(240 240 bounds 5)
string(JSON said GET "${out}" warnings)
expect_says("${said}" "millimetres taken for metres")

must_succeed(inspect corner.mesh --scale 0.001 --quiet --json -)
expect_between(2.30399e-3 2.30401e-3 volume)
string(JSON count LENGTH "${out}" warnings)
if(count)
    message(SEND_ERROR "a healthy mesh draws warnings:\n${out}")
endif()

must_succeed(inspect corner.mesh --scale 1e-6)
expect_says("${out}" "metres taken for millimetres")
