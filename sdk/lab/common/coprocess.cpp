#include "lab/common/coprocess.h"

#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

extern char **environ;

namespace sphc::host {
namespace {

int spawn(const std::vector<std::string> &arguments, int its_end, int our_end, pid_t *child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, its_end, 0);
  posix_spawn_file_actions_adddup2(&actions, its_end, 1);
  posix_spawn_file_actions_addclose(&actions, our_end);
  std::vector<std::string> copies = arguments;
  std::vector<char *> pointers;
  for (std::string &copy : copies) pointers.push_back(copy.data());
  pointers.push_back(nullptr);
  const int failure = posix_spawnp(child, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failure;
}

}  // namespace

Coprocess::Coprocess(const std::vector<std::string> &arguments, int patience_s) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error(std::string("no socket pair: ") + std::strerror(errno) + "; close other programs");
  const int failure = spawn(arguments, ends[1], ends[0], &child_);
  close(ends[1]);
  if (failure != 0) {
    close(ends[0]);
    throw std::runtime_error("cannot start " + arguments[0] + ": " + std::strerror(failure) + "; is it installed?");
  }
  socket_ = ends[0];
  const timeval patience = {patience_s, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
}

Coprocess::~Coprocess() {
  close(socket_);  // which it reads as the end
  for (int i = 0; i < 100; ++i) {
    if (waitpid(child_, nullptr, WNOHANG) != 0) return;
    usleep(10000);
  }
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

bool Coprocess::write(const void *data, size_t size) {
  const char *from = static_cast<const char *>(data);
  while (size > 0) {
    const ssize_t sent = send(socket_, from, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    from += sent;
    size -= static_cast<size_t>(sent);
  }
  return true;
}

bool Coprocess::read(void *data, size_t size) {
  char *to = static_cast<char *>(data);
  while (size > 0) {
    const ssize_t got = recv(socket_, to, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    size -= static_cast<size_t>(got);
  }
  return true;
}

std::shared_ptr<Coprocess> startScript(const std::string &python, const std::string &script) {
  try {
    auto process = std::make_shared<Coprocess>(std::vector<std::string>{python, "-c", script});
    char greeting[4];
    const bool ready = process->read(greeting, sizeof greeting) && std::memcmp(greeting, "SPHC", 4) == 0;
    return ready ? process : nullptr;
  } catch (const std::runtime_error &) {
    return nullptr;
  }
}

}  // namespace sphc::host
