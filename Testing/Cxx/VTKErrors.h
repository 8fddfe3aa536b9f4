// SPDX-License-Identifier: BSD-3-Clause
#ifndef VTKErrors_h
#define VTKErrors_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <string>

/// Catches the errors or warnings of one VTK object, which are then not printed.
template <unsigned long Event>
class MessageCatcher
{
public:
  explicit MessageCatcher(vtkObject* object)
    : Object(object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        auto* catcher = static_cast<MessageCatcher*>(self);
        catcher->Messages += static_cast<const char*>(text);
        ++catcher->Number;
      });
    this->Tag = object->AddObserver(Event, this->Command);
  }
  ~MessageCatcher() { this->Object->RemoveObserver(this->Tag); }
  MessageCatcher(const MessageCatcher&) = delete;
  MessageCatcher& operator=(const MessageCatcher&) = delete;

  [[nodiscard]] int Count() const { return this->Number; }
  [[nodiscard]] const std::string& Text() const { return this->Messages; }

private:
  vtkObject* Object;
  vtkNew<vtkCallbackCommand> Command;
  unsigned long Tag = 0;
  int Number = 0;
  std::string Messages;
};

using ErrorCatcher = MessageCatcher<vtkCommand::ErrorEvent>;
using WarningCatcher = MessageCatcher<vtkCommand::WarningEvent>;

#endif
