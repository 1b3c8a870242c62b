#include "failure.h"

#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>

namespace sphc::recording {

void setMessage(sphc_message *message, const char *text) noexcept {
  if (!message) return;
  std::strncpy(message->text, text, SPHC_MESSAGE_BYTES - 1);
  message->text[SPHC_MESSAGE_BYTES - 1] = '\0';
}

sphc_status explainException(sphc_message *message) noexcept {
  try {
    throw;
  } catch (const Failure &failure) {
    setMessage(message, failure.what());
    return failure.status();
  } catch (const std::filesystem::filesystem_error &error) {
    setMessage(message, error.what());
    return SPHC_E_DEVICE;
  } catch (const std::bad_alloc &) {
    setMessage(message, "out of memory");
    return SPHC_E_DEVICE;
  } catch (const std::system_error &error) {  // of std::thread
    const bool is_full = error.code() == std::errc::resource_unavailable_try_again;
    setMessage(message, is_full ? "too many threads, or too little memory for one more" : error.what());
    return SPHC_E_DEVICE;
  } catch (const std::exception &error) {
    setMessage(message, error.what());
    return SPHC_E_INTERNAL;
  } catch (...) {
    setMessage(message, "unknown exception");
    return SPHC_E_INTERNAL;
  }
}

std::string shortPath(const std::string &path) {
  constexpr size_t kShown = 90;  // leaves room for cause and cure
  return path.size() <= kShown ? path : "..." + path.substr(path.size() - kShown + 3);
}

}  // namespace sphc::recording
