// A YAML mapping whose keys are asked for one by one; every failure names file and key.
#pragma once
#include <yaml-cpp/yaml.h>

#include <string>
#include <utility>
#include <vector>

#include "host/cameras/part.h"

namespace sphc::host {

class YamlMap {
 public:
  // Refuses text that is no mapping, or has a key twice.
  static YamlMap parse(const TextFile &file);

  std::string path(const std::string &key) const { return path_.empty() ? key : path_ + "." + key; }
  const std::string &file() const { return file_; }
  bool has(const std::string &key) const;
  std::vector<std::string> keys() const;

  YamlMap map(const std::string &key) const;
  std::string text(const std::string &key, const std::string &example) const;
  // Numbers of a list, or of a list of lists, in their order; finite.
  std::vector<double> numbers(const std::string &key, const std::string &example) const;
  uint32_t pixels(const std::string &key) const;

  [[noreturn]] void refuse(const std::string &key, const std::string &why) const;

 private:
  YamlMap(YAML::Node node, std::string file, std::string path);
  YAML::Node require(const std::string &key, const std::string &example) const;

  YAML::Node node_;
  std::string file_, path_;
};

}  // namespace sphc::host
