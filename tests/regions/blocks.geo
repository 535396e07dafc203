// A unit cube in two layers of tetrahedra: soft below 0.4, hard above.
// gmsh -3 -format msh41 blocks.geo
SetFactory("OpenCASCADE");

Box(1) = {0, 0, 0, 1, 1, 0.4};
Box(2) = {0, 0, 0.4, 1, 1, 0.6};
BooleanFragments{ Volume{1, 2}; Delete; }{ }
Mesh.CharacteristicLengthMin = 0.3;
Mesh.CharacteristicLengthMax = 0.3;

Physical Volume("soft") = {1};
Physical Volume("hard") = {2};
Physical Surface("bottom") = Surface In BoundingBox {-0.1, -0.1, -0.1, 1.1, 1.1, 0.1};
Physical Surface("top") = Surface In BoundingBox {-0.1, -0.1, 0.9, 1.1, 1.1, 1.1};
Physical Surface("left") = Surface In BoundingBox {-0.1, -0.1, -0.1, 0.1, 1.1, 1.1};
Physical Surface("right") = Surface In BoundingBox {0.9, -0.1, -0.1, 1.1, 1.1, 1.1};
Physical Surface("front") = Surface In BoundingBox {-0.1, -0.1, -0.1, 1.1, 0.1, 1.1};
Physical Surface("back") = Surface In BoundingBox {-0.1, 0.9, -0.1, 1.1, 1.1, 1.1};
