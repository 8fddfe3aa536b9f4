// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Tracked_h
#define po_Tracked_h

namespace po
{
/// Settings that know whether they were changed since they were last used.
template <typename Settings>
class Tracked
{
public:
  [[nodiscard]] Settings& change()
  {
    isNew_ = true;
    return settings_;
  }

  /// Also before the first use.
  [[nodiscard]] bool isNew() const { return isNew_; }

  [[nodiscard]] const Settings& get() const { return settings_; }

  [[nodiscard]] const Settings& use()
  {
    isNew_ = false;
    return settings_;
  }

private:
  Settings settings_;
  bool isNew_ = true;
};
}

#endif
