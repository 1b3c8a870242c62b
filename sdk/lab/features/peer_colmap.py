"""COLMAP's SIFT through pycolmap, image by image over stdin and stdout; peer_colmap.cpp is the other end.

Request: u32 width, height; the image's bytes.
Reply: u32 count, 0; f64 seconds; f32[2] a pixel each; f32[128] a histogram each.
"""
import os
import struct
import sys
import time
import warnings

os.environ["OMP_NUM_THREADS"] = "1"
os.environ["GLOG_minloglevel"] = "2"
warnings.simplefilter("ignore")
ABSENT = 3
try:
    import numpy
    import pycolmap
except ImportError:
    sys.exit(ABSENT)

REQUEST = struct.Struct("<2I")


def read(stream, size):
    data = stream.read(size)
    if len(data) < size:
        sys.exit(0)
    return data


def make_sift():
    options = pycolmap.FeatureExtractionOptions()
    options.num_threads = 1
    options.use_gpu = False
    options.sift.max_num_features = 1000
    options.sift.max_num_orientations = 1
    return pycolmap.Sift(options, pycolmap.Device.cpu)


def answer(sift, stream):
    width, height = REQUEST.unpack(read(stream, REQUEST.size))
    image = numpy.frombuffer(read(stream, width * height), numpy.uint8).reshape(height, width)
    begin = time.process_time_ns()
    keypoints, descriptors = sift.extract(image)
    seconds = 1e-9 * (time.process_time_ns() - begin)
    # Unit vectors of roots (its default): their squares are the histogram.
    histograms = numpy.square(descriptors.astype(numpy.float32))
    return (struct.pack("<2Id", len(keypoints), 0, seconds) + keypoints[:, :2].astype(numpy.float32).tobytes()
            + histograms.tobytes())


def main():
    incoming, outgoing = os.fdopen(0, "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints stays out of the way
    sift = make_sift()
    outgoing.write(b"SPHC")
    outgoing.flush()
    while True:
        outgoing.write(answer(sift, incoming))
        outgoing.flush()


main()
