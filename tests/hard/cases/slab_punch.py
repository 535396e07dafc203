"""The plane scene with the same cells: forces, energy, nodes in contact."""
from judge import Run, near, same

PLANE = {
    "punch_dm_plex_box_faces": "6,4",
    "punch_dm_plex_box_lower": "0.3,0",
    "punch_dm_plex_box_upper": "0.7,0.4",
    "punch_bc_traction_top": "0,0-1-x",
    "block_dm_plex_box_faces": "16,8",
    "block_dm_plex_box_lower": "0,-0.5",
    "block_dm_plex_box_upper": "1,0",
    "block_bc_displacement_bottom": "0,0",
}


def judge(run):
    options = {name: text for name, text in run.summary["options"].items() if not text.startswith("front,back") and name != "output"} | PLANE
    twin = Run(run.program, run.mpiexec, run.ranks, run.folder / "plane", [word for name, text in options.items() for word in ("-" + name, text) if word])
    twin.require_solved()
    near("force", [f for k, f in enumerate(run.pair("joint")["force"]) if k != 1], twin.pair("joint")["force"], relative=1e-8)
    near("potential", run.summary["energy"]["potential"], twin.summary["energy"]["potential"], relative=1e-8)
    same("nodes", run.pair("joint")["active_nodes"], 3 * twin.pair("joint")["active_nodes"])
