// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_VTKErrors_h
#define po_VTKErrors_h

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
    : object_(object)
  {
    command_->SetClientData(this);
    command_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* message)
      {
        auto* catcher = static_cast<MessageCatcher*>(self);
        catcher->messages_ += static_cast<const char*>(message);
        ++catcher->number_;
      });
    tag_ = object->AddObserver(Event, command_);
  }
  ~MessageCatcher() { object_->RemoveObserver(tag_); }
  MessageCatcher(const MessageCatcher&) = delete;
  MessageCatcher& operator=(const MessageCatcher&) = delete;

  [[nodiscard]] int count() const { return number_; }
  [[nodiscard]] const std::string& text() const { return messages_; }

private:
  vtkObject* object_;
  vtkNew<vtkCallbackCommand> command_;
  unsigned long tag_ = 0;
  int number_ = 0;
  std::string messages_;
};

using ErrorCatcher = MessageCatcher<vtkCommand::ErrorEvent>;
using WarningCatcher = MessageCatcher<vtkCommand::WarningEvent>;

#endif
