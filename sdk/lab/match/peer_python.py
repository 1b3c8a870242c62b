"""Matchers of faiss and hnswlib over stdin and stdout; peer_python.cpp is the other end.

Greeting: SPHC, then u8 whether there is faiss, u8 whether there is hnswlib.
Request: u32 order, handle, a, b.  Replies follow their order:
  1 rows: u32 handle; a rows of 128 bytes follow: the map when b is 0, the queries when b is 1.  No reply.
  2 make: index number `handle` of the kind a (below) with the parameter b, over the map.  Reply: f64 seconds.
  3 search: with index `handle` and the parameter a.  Reply: f64 seconds.
  4 answer: of the last search.  Reply: i64[2] indices and f32[2] distances a query.
  5 forget: all indices.  No reply.
"""
import os
import struct
import sys
import time

os.environ["OMP_NUM_THREADS"] = "1"
ABSENT = 3
try:
    import numpy
except ImportError:
    sys.exit(ABSENT)
try:
    import faiss
    faiss.omp_set_num_threads(1)
except ImportError:
    faiss = None
try:
    import hnswlib
except ImportError:
    hnswlib = None

REQUEST = struct.Struct("<4I")
ROWS, MAKE, SEARCH, ANSWER, FORGET = 1, 2, 3, 4, 5
FLAT, IVF, FAISS_HNSW, HNSWLIB = 1, 2, 3, 4
DIMENSIONS = 128


def read(stream, size):
    data = stream.read(size)
    if len(data) < size:
        sys.exit(0)
    return data


def make_flat(rows, _):
    index = faiss.IndexFlatL2(DIMENSIONS)
    index.add(rows)
    return lambda queries, _: index.search(queries, 2)


def make_ivf(rows, cells):
    quantizer = faiss.IndexFlatL2(DIMENSIONS)
    index = faiss.IndexIVFFlat(quantizer, DIMENSIONS, cells)
    index.train(rows[:64 * cells])
    index.add(rows)

    def search(queries, probes):
        index.nprobe = probes
        return index.search(queries, 2)
    return search


def make_faiss_hnsw(rows, links):
    index = faiss.IndexHNSWFlat(DIMENSIONS, links)
    index.add(rows)

    def search(queries, effort):
        index.hnsw.efSearch = effort
        return index.search(queries, 2)
    return search


def make_hnswlib(rows, links):
    index = hnswlib.Index(space="l2", dim=DIMENSIONS)
    index.init_index(max_elements=len(rows), M=links, ef_construction=100, random_seed=1)
    index.add_items(rows, num_threads=1)

    def search(queries, effort):
        index.set_ef(effort)
        labels, distances = index.knn_query(queries, k=2, num_threads=1)
        return distances, labels
    return search


MAKERS = {FLAT: make_flat, IVF: make_ivf, FAISS_HNSW: make_faiss_hnsw, HNSWLIB: make_hnswlib}


class Server:
    def __init__(self):
        self.tables, self.indices, self.found = {}, {}, None

    def timed(self, work):
        begin = time.process_time_ns()
        result = work()
        return result, struct.pack("<d", 1e-9 * (time.process_time_ns() - begin))

    def reply(self, stream):
        order, handle, a, b = REQUEST.unpack(read(stream, REQUEST.size))
        if order == ROWS:
            table = numpy.frombuffer(read(stream, DIMENSIONS * a), numpy.uint8).reshape(a, DIMENSIONS)
            self.tables[b] = table.astype(numpy.float32)
        elif order == MAKE:
            self.indices[handle], seconds = self.timed(lambda: MAKERS[a](self.tables[0], b))
            return seconds
        elif order == SEARCH:
            self.found, seconds = self.timed(lambda: self.indices[handle](self.tables[1], a))
            return seconds
        elif order == ANSWER:
            squared, indices = self.found
            distances = numpy.sqrt(numpy.maximum(squared, 0)).astype("<f4")
            return numpy.asarray(indices).astype("<i8").tobytes() + distances.tobytes()
        elif order == FORGET:
            self.indices.clear()
        return b""


def main():
    incoming, outgoing = os.fdopen(0, "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints stays out of the way
    outgoing.write(b"SPHC" + bytes([faiss is not None, hnswlib is not None]))
    server = Server()
    while True:
        outgoing.flush()
        outgoing.write(server.reply(incoming))


main()
