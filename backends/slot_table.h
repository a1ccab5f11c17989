// Objects by handle. A slot's generation grows when its object dies, so a handle that outlives its object is found out.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace volumark {

template <class HandleType, class Object>
class SlotTable {
 public:
  // `make(index)` creates the backend's object; when it throws, the table is as before.
  template <class Make>
  HandleType insert(Object object, Make&& make) {
    uint32_t index = 0;
    while (index < slots_.size() && slots_[index].object) ++index;
    if (index == slots_.size()) slots_.emplace_back();
    make(index);
    Slot& slot = slots_[index];
    slot.object.emplace(std::move(object));
    return {index, slot.generation};
  }

  Object* find(HandleType handle) {
    if (handle.index >= slots_.size()) return nullptr;
    Slot& slot = slots_[handle.index];
    return slot.object && slot.generation == handle.generation ? &*slot.object : nullptr;
  }

  void erase(HandleType handle) {
    Slot& slot = slots_[handle.index];
    slot.object.reset();
    ++slot.generation;
  }

  std::vector<const Object*> all() const {
    std::vector<const Object*> out;
    for (const Slot& slot : slots_) {
      if (slot.object) out.push_back(&*slot.object);
    }
    return out;
  }

 private:
  struct Slot {
    std::optional<Object> object;
    uint32_t generation = 1;
  };
  std::vector<Slot> slots_;
};

}  // namespace volumark
