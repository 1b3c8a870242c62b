#include "host/report/results.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "host/base/write_file.h"
#include "host/report/file.h"

namespace sphc::host {
namespace {

std::vector<std::string> readLines(const std::string &path) {
  const std::vector<uint8_t> bytes = readBytes(path);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

}  // namespace

void replaceRows(const std::string &path, const std::string &head, const std::string &key,
                 const std::vector<std::string> &rows) {
  std::vector<std::string> lines = {head};
  if (std::filesystem::is_regular_file(path)) lines = readLines(path);
  if (lines.empty() || lines.front() != head)
    throw std::runtime_error(path + " holds no results of this kind: its first line is not \"" + head +
                             "\"; choose another file");
  const auto is_old = [&key](const std::string &line) { return line.compare(0, key.size(), key) == 0; };
  const auto first = std::find_if(lines.begin() + 1, lines.end(), is_old);
  const auto place = first - lines.begin();
  lines.erase(std::remove_if(first, lines.end(), is_old), lines.end());
  lines.insert(lines.begin() + place, rows.begin(), rows.end());
  std::string text;
  for (const std::string &line : lines) text += line + "\n";
  writeFile(path, text);
}

}  // namespace sphc::host
