#!/bin/sh -e
# Rewrites the meshes that the reader tests take: needs gmsh.
cd "$(dirname "$0")"
for order in 1 2; do
    for binary in 0 1; do
        kind=$([ $binary = 1 ] && echo binary || echo ascii)
        for version in 22 41; do
            gmsh ball_on_base.geo -3 -v 0 -order $order -format msh$version \
                -setnumber Mesh.Binary $binary -o msh${version}_${kind}_$order.msh
        done
        gmsh ball_on_base.geo -3 -v 0 -order $order -format vtk \
            -setnumber Mesh.Binary $binary -o ${kind}_$order.vtk
    done
    gmsh ball_on_base.geo -3 -v 0 -order $order -format mesh -o ascii_$order.mesh
done
