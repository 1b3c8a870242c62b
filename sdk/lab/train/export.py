#!/usr/bin/env python3
"""Writes a trained network as the two files that the audit reads, and a vector for its test.

The painter's weights become 8-bit numbers with one scale a channel, which makes the file a quarter as large; OpenCV 4.6
reads them through a Cast, and the scale follows the convolution.

    export.py FILE.pt FOLDER NAME      FOLDER/NAME.embedding.onnx, FOLDER/NAME.painter.onnx
    export.py FILE.pt FOLDER NAME --golden GOLDEN.csv
"""
import argparse
import os

import numpy as np
import onnx
import torch
from onnx import TensorProto, helper, numpy_helper
from torch import nn
from network import GRID, INPUT, PLANES, Embedding, Painter, cells, paint
from view import SIDE


def golden_points():
    """400 keypoints that a test can make as well: no two machines need to share a random generator."""
    i = np.arange(400)
    pixel = np.stack([(i * 37 % 1280) / 10 + .02, (i * 101 % 1270) / 10 + .03], 1)
    return pixel, (i[:, None] * 7 + np.arange(128) * 13) % 120


def write_golden(embedding, painter, path):
    pixel, descriptor = golden_points()
    cell, offset = cells(pixel)
    keypoints = np.concatenate([descriptor / 128, offset], 1).astype(np.float32)
    with torch.no_grad():
        picture = paint(embedding, painter, torch.from_numpy(keypoints), torch.ones(len(cell)),
                        torch.from_numpy(cell), 1)[0, 0].numpy()
    with open(path, "w") as stream:
        stream.write("x,y,grey\n")
        for y in range(3, SIDE, 25):
            for x in range(3, SIDE, 25):
                stream.write(f"{x},{y},{picture[y, x]:.6f}\n")


def fold(module):
    """Convolution, normalisation and ReLU become convolution and ReLU."""
    for name, child in module.named_children():
        if isinstance(child, nn.Sequential) and len(child) == 3 and isinstance(child[1], nn.BatchNorm2d):
            setattr(module, name, nn.Sequential(nn.utils.fusion.fuse_conv_bn_eval(child[0], child[1]), child[2]))
        else:
            fold(child)


def scales(weight):
    """Of each output channel; its largest weight is 127."""
    return np.abs(weight).max((1, 2, 3), keepdims=True).clip(1e-9) / 127


def quantise(painter):
    for module in painter.modules():
        if isinstance(module, nn.Conv2d):
            weight = module.weight.detach().numpy()
            module.weight.data = torch.from_numpy((np.round(weight / scales(weight)) * scales(weight)).astype(np.float32))


def pack(path):
    """The weights of all convolutions as 8-bit numbers; what is computed stays the same."""
    model = onnx.load(path)
    graph, numbers, nodes = model.graph, [], []
    weights = {tensor.name: numpy_helper.to_array(tensor) for tensor in graph.initializer}
    for node in graph.node:
        if node.op_type != "Conv":
            nodes.append(node)
            continue
        weight, bias, name = weights.pop(node.input[1]), weights.pop(node.input[2]), node.output[0]
        scale = scales(weight).astype(np.float32)
        numbers += [numpy_helper.from_array(np.round(weight / scale).astype(np.int8), name + "_int8"),
                    numpy_helper.from_array(bias / scale.reshape(-1), name + "_bias"),
                    numpy_helper.from_array(scale.reshape(1, -1, 1, 1), name + "_scale")]
        node.input[1], node.input[2], node.output[0] = name + "_weight", name + "_bias", name + "_unscaled"
        nodes += [helper.make_node("Cast", [name + "_int8"], [name + "_weight"], name + "_cast", to=TensorProto.FLOAT),
                  node, helper.make_node("Mul", [name + "_unscaled", name + "_scale"], [name], name + "_mul")]
    numbers += [numpy_helper.from_array(value, name) for name, value in weights.items()]
    del graph.initializer[:], graph.node[:]
    graph.initializer.extend(numbers)
    graph.node.extend(nodes)
    onnx.checker.check_model(model)
    onnx.save(model, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trained")
    parser.add_argument("folder")
    parser.add_argument("name")
    parser.add_argument("--golden")
    options = parser.parse_args()
    state, embedding, painter = torch.load(options.trained), Embedding().eval(), Painter().eval()
    embedding.load_state_dict(state["embedding"]), painter.load_state_dict(state["painter"])
    fold(painter)
    quantise(painter)
    start = os.path.join(options.folder, options.name)
    torch.onnx.export(embedding, torch.zeros(2, INPUT), start + ".embedding.onnx", opset_version=11,
                      input_names=["keypoints"], dynamic_axes={"keypoints": {0: "count"}})
    torch.onnx.export(painter, torch.zeros(1, PLANES, GRID, GRID), start + ".painter.onnx", opset_version=11)
    pack(start + ".painter.onnx")
    if options.golden:
        write_golden(embedding, painter, options.golden)


if __name__ == "__main__":
    main()
