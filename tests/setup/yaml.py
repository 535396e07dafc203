"""A mesh is found beside the file of -options_file_yaml that names it; options of YAML and behind a prefix count, and the summary tells them."""
from judge import Run, near, same

MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "floor"
2 2 "all"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
2
1 1 2 1 1 1 2
2 3 2 2 2 1 2 3 4
$EndElements
"""
YAML = """bodies: block
block_dm_plex_filename: block.msh
block_young: 1000
block_poisson: 0.3
block_bc_displacement: floor
block_bc_displacement_floor: 0,0
block_body_force: 0,-1
"""


def judge(run):
    folder = run.folder / "beside"
    folder.mkdir()
    (folder / "block.msh").write_text(MESH)
    (folder / "scene.yaml").write_text(YAML)
    case = Run(run.program, run.mpiexec, run.ranks, run.folder / "yaml", ["-options_file_yaml", str(folder / "scene.yaml")])
    case.require_solved()
    same("cells", case.summary["scene"]["bodies"]["block"]["cells"], 1)
    same("option of the file", case.summary["options"]["block_young"], "1000")
    stiff = {"text": ["-options_string_yaml", "{block_young: 2000, title: stiff}"], "prefix": ["-prefix_push", "block_", "-young", "2000", "-prefix_pop", "-title", "stiff"],
             "string": ["-options_string", '-block_young 2000 -title "stiff" # both']}
    for name, words in stiff.items():
        other = Run(run.program, run.mpiexec, run.ranks, run.folder / name, case.arguments + words)
        other.require_solved()
        options = other.summary["options"]
        same("options", (options["block_young"], options["title"], "young" in options, other.summary["scene"]["title"]), ("2000", "stiff", False, "stiff"))
        near("half the energy", other.summary["energy"]["potential"], case.summary["energy"]["potential"] / 2, relative=1e-12)
