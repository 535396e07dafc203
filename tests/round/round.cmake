# Round parts: statics. Each test begins with rests.opts and makes its other scenes itself (scenes.py, roundmesh.py).
foreach(part discs sled pipe cam inclined balls rows roles heaps fits shrink copies ellipse rim rigid)
  mortise_scene_test(${part} SCENE rests CHECK ${part}.py ONLY_RANKS "the check itself takes several")
endforeach()
