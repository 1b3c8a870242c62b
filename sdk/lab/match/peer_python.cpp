#include <cstring>
#include <stdexcept>

#include "lab/common/coprocess.h"
#include "lab/match/variant.h"
#include "peer_python_script.h"

namespace sphc::host {
namespace {

constexpr int kPatienceS = 3600;          // a graph of a large map takes long to make
constexpr size_t kLargestGraph = 200000;  // and beyond this too long
constexpr size_t kLargestFlat = 200000;

enum Order : uint32_t { kRows = 1, kMake = 2, kSearch = 3, kAnswer = 4, kForget = 5 };
enum Kind : uint32_t { kFlat = 1, kIvf = 2, kFaissHnsw = 3, kHnswlib = 4 };

struct Request {
  uint32_t order, handle, a, b;
};

// The Python end, and which map it has.
class Server {
 public:
  explicit Server(const std::string &python) : process_({python, "-c", kMatchPeerPythonScript}, kPatienceS) {}

  bool greet() { return process_.read(greeting_, sizeof greeting_) && std::memcmp(greeting_, "SPHC", 4) == 0; }
  bool hasFaiss() const { return greeting_[4] != 0; }
  bool hasHnswlib() const { return greeting_[5] != 0; }

  void give(const MatchCase &c) {
    if (given_ == c.file.get()) return;
    given_ = c.file.get();
    made_.clear();
    send({kForget, 0, 0, 0});
    sendRows(c.map.descriptors().data(), c.map.pointCount(), 0);
    sendRows(c.queries.data(), c.queries.size(), 1);
  }
  // The handle of an index over the map given.
  uint32_t make(Kind kind, uint32_t parameter) {
    for (size_t i = 0; i < made_.size(); ++i)
      if (made_[i].first == kind && made_[i].second == parameter) return static_cast<uint32_t>(i);
    made_.push_back({kind, parameter});
    const auto handle = static_cast<uint32_t>(made_.size() - 1);
    double seconds = 0;
    send({kMake, handle, kind, parameter});
    receive(&seconds, sizeof seconds);
    return handle;
  }
  double search(uint32_t handle, uint32_t parameter) {
    double seconds = 0;
    send({kSearch, handle, parameter, 0});
    receive(&seconds, sizeof seconds);
    return seconds;
  }
  std::vector<TopTwo> answer(size_t count) {
    std::vector<int64_t> indices(2 * count);
    std::vector<float> distances(2 * count);
    send({kAnswer, 0, 0, 0});
    receive(indices.data(), indices.size() * sizeof indices[0]);
    receive(distances.data(), distances.size() * sizeof distances[0]);
    std::vector<TopTwo> answer(count);
    for (size_t q = 0; q < count; ++q)
      answer[q] = {indices[2 * q], static_cast<double>(distances[2 * q]),
                   static_cast<double>(distances[2 * q + 1])};
    return answer;
  }

 private:
  void sendRows(const Descriptor *rows, size_t count, uint32_t table) {
    send({kRows, 0, static_cast<uint32_t>(count), table});
    check(process_.write(rows, count * sizeof *rows));
  }
  void send(const Request &request) { check(process_.write(&request, sizeof request)); }
  void receive(void *data, size_t bytes) { check(process_.read(data, bytes)); }
  static void check(bool alive) {
    if (!alive)
      throw std::runtime_error(
          "the matchers' Python process stopped answering; run again, or without it by --no-peers");
  }

  Coprocess process_;
  char greeting_[6] = {};
  const void *given_ = nullptr;
  std::vector<std::pair<Kind, uint32_t>> made_;
};

class PythonSearch : public MatchSearch {
 public:
  PythonSearch(std::shared_ptr<Server> server, uint32_t handle, uint32_t parameter, size_t queries)
      : server_(std::move(server)), handle_(handle), parameter_(parameter), queries_(queries) {}
  double seconds() override { return server_->search(handle_, parameter_); }
  std::vector<TopTwo> answer() override {
    seconds();
    return server_->answer(queries_);
  }

 private:
  std::shared_ptr<Server> server_;
  uint32_t handle_, parameter_;
  size_t queries_;
};

std::shared_ptr<Server> start(const std::string &python) {
  try {
    auto server = std::make_shared<Server>(python);
    return server->greet() ? server : nullptr;
  } catch (const std::runtime_error &) {
    return nullptr;
  }
}

struct Peer {
  const char *name;
  Kind kind;
  uint32_t made_with;  // for IVF: 0, as many cells as our map has
  uint32_t searched_with;
  size_t largest_map;
};

constexpr Peer kPeers[] = {{"faiss flat", kFlat, 0, 0, kLargestFlat},
                           {"faiss ivf, 4 probes", kIvf, 0, 4, SIZE_MAX},
                           {"faiss ivf, 8 probes", kIvf, 0, 8, SIZE_MAX},
                           {"faiss ivf, 16 probes", kIvf, 0, 16, SIZE_MAX},
                           {"faiss ivf, 32 probes", kIvf, 0, 32, SIZE_MAX},
                           {"faiss hnsw16, ef 16", kFaissHnsw, 16, 16, kLargestGraph},
                           {"faiss hnsw16, ef 64", kFaissHnsw, 16, 64, kLargestGraph},
                           {"hnswlib 16, ef 16", kHnswlib, 16, 16, kLargestGraph},
                           {"hnswlib 16, ef 64", kHnswlib, 16, 64, kLargestGraph}};

MatchVariant variantOf(const Peer &peer, const std::shared_ptr<Server> &server, const std::string &python) {
  MatchVariant variant;
  variant.name = peer.name;
  variant.largest_map = peer.largest_map;
  const bool graph = peer.kind == kHnswlib;
  if (!server || !(graph ? server->hasHnswlib() : server->hasFaiss())) {
    variant.absent = "not found by " + python + ": pip install " + (graph ? "hnswlib" : "faiss-cpu") +
                     " numpy, and name that Python with --python";
    return variant;
  }
  variant.prepare = [server, peer](const MatchCase &c) {
    server->give(c);
    const uint32_t handle = server->make(peer.kind, peer.kind == kIvf ? c.map.cellCount() : peer.made_with);
    return std::make_unique<PythonSearch>(server, handle, peer.searched_with, c.queries.size());
  };
  return variant;
}

}  // namespace

std::vector<MatchVariant> pythonMatchPeers(const std::string &python) {
  const std::shared_ptr<Server> server = start(python);
  std::vector<MatchVariant> variants;
  for (const Peer &peer : kPeers) variants.push_back(variantOf(peer, server, python));
  return variants;
}

}  // namespace sphc::host
