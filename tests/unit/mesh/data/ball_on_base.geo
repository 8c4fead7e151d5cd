// An eighth of a ball of radius 1 on a unit cube, coarse. The files beside this one are its meshes,
// written by Gmsh 4.8.4 (make_data.sh).
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1, 0, Pi/2, Pi/2};
Box(2) = {0, 0, -1, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Physical Volume("ball", 7) = {1};
Physical Volume("the base", 9) = {2};
Mesh.MeshSizeMin = 3;
Mesh.MeshSizeMax = 3;
