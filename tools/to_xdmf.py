#!/usr/bin/env python3
"""Write an XDMF file beside a hydro1d result, so that ParaView and VisIt open it: the column as a moving line.

The XDMF holds no data; it points into the HDF5 file, which must stay where it is.
"""

import argparse
import os
from xml.sax.saxutils import escape

import h5py
from contents import open_result, run_script


def xdmf_text(path, reference):
    """The XDMF of the result `path`, which it calls `reference`."""
    with open_result(path) as file:
        times = file["time"][:]
        zones = file["zone"].size
        shapes = {name: file[name].shape for name in file if isinstance(file[name], h5py.Dataset)}
    fields = {name: shape for name, shape in shapes.items() if shape in ((len(times), zones), (len(times), zones + 1))}
    lines = ['<?xml version="1.0"?>', '<Xdmf Version="3.0">', "<Domain>"]
    lines += _connections(zones)
    lines.append('<Grid Name="column" GridType="Collection" CollectionType="Temporal">')
    for row, time in enumerate(times):
        lines += _grid(escape(reference), row, float(time), len(times), zones, fields)
    return "\n".join([*lines, "</Grid>", "</Domain>", "</Xdmf>", ""])


def _connections(zones):
    """Which nodes a zone lies between, and the zeros of y and z, once for all times."""
    pairs = " ".join(f"{zone} {zone + 1}" for zone in range(zones))
    zeros = " ".join("0" for _ in range(zones + 1))
    return [
        f'<DataItem Name="pairs" Dimensions="{zones} 2" NumberType="Int" Format="XML">{pairs}</DataItem>',
        f'<DataItem Name="zeros" Dimensions="{zones + 1}" NumberType="Float" Format="XML">{zeros}</DataItem>',
    ]


def _grid(reference, row, time, count, zones, fields):
    zero = '<DataItem Reference="XML">/Xdmf/Domain/DataItem[@Name="zeros"]</DataItem>'
    yield f'<Grid Name="t{row}"><Time Value="{time:.9g}"/>'
    yield f'<Topology TopologyType="Polyline" NodesPerElement="2" NumberOfElements="{zones}">'
    yield '<DataItem Reference="XML">/Xdmf/Domain/DataItem[@Name="pairs"]</DataItem></Topology>'
    yield f'<Geometry GeometryType="X_Y_Z">{_slab(reference, "position", row, count, zones + 1)}{zero}{zero}</Geometry>'
    for name, shape in fields.items():
        centre = "Cell" if shape[1] == zones else "Node"
        item = _slab(reference, name, row, count, shape[1])
        yield f'<Attribute Name="{escape(name)}" Center="{centre}">{item}</Attribute>'
    yield "</Grid>"


def _slab(reference, name, row, count, size):
    """One row of a dataset over (time, …)."""
    shape = f'Dimensions="{count} {size}" NumberType="Float" Precision="8"'
    return (
        f'<DataItem ItemType="HyperSlab" Dimensions="{size}">'
        f'<DataItem Dimensions="3 2" NumberType="Int" Format="XML">{row} 0 1 1 1 {size}</DataItem>'
        f'<DataItem {shape} Format="HDF">{reference}:/{name}</DataItem>'
        "</DataItem>"
    )


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="a result, RUN.h5")
    parser.add_argument("-o", "--output", help="default: RUN.xdmf beside it")
    args = parser.parse_args(argv)
    target = args.output or os.path.splitext(args.run)[0] + ".xdmf"
    reference = os.path.relpath(args.run, os.path.dirname(os.path.abspath(target)))
    text = xdmf_text(args.run, reference)
    with open(target, "w") as stream:
        stream.write(text)
    print(target)


if __name__ == "__main__":
    run_script(main)
