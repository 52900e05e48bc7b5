#pragma once
// What a scenario says of the things that only one experiment knows: a struct of each experiment's
// own, filled by the keys that its folder brings.
#include <any>
#include <map>
#include <typeindex>

namespace sim {

class ExperimentSettings {
 public:
  /// With the defaults of T until a key changes them.
  template <class T>
  T& of() {
    std::any& settings = all_[typeid(T)];
    if (!settings.has_value()) settings = T{};
    return std::any_cast<T&>(settings);
  }
  template <class T>
  const T& of() const {
    static const T defaults{};
    const auto found = all_.find(typeid(T));
    return found == all_.end() ? defaults : std::any_cast<const T&>(found->second);
  }

 private:
  std::map<std::type_index, std::any> all_;
};

}  // namespace sim
