"""meshes.py -- the cells of an HDF5 file of mortise, which has types side by side, for tests that look into it."""
import numpy as np

# XDMF's numbers of triangles, quads, tetrahedra and hexahedra of order 1 and 2, and their nodes.
SIZES = {4: 3, 5: 4, 36: 6, 35: 9, 6: 4, 9: 8, 38: 10, 50: 27}


def cells_by_size(cells):
    """{nodes of a cell: (places in the list of cells, nodes [count][size])}; mixed cells are a list of XDMF's number of the type
    followed by the nodes of each."""
    if cells.ndim == 2:
        return {cells.shape[1]: (np.arange(len(cells)), cells)}
    found, begin, place = {}, 0, 0
    while begin < len(cells):
        size = SIZES[int(cells[begin])]
        places, nodes = found.setdefault(size, ([], []))
        places.append(place)
        nodes.append(cells[begin + 1:begin + 1 + size])
        begin, place = begin + 1 + size, place + 1
    return {size: (np.array(places), np.array(nodes)) for size, (places, nodes) in found.items()}


def bodies_of_nodes(cells, body, num_nodes):
    """Index of the body of every node."""
    owner = np.full(num_nodes, -1)
    for places, nodes in cells_by_size(cells).values():
        owner[nodes] = body[places, None]
    return owner
