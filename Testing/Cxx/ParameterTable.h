// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParameterTable_h
#define po_ParameterTable_h

#include "vtkSmartPointer.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLUtilities.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

/// Elements of a parameter's value: numbers, or one string.
struct ParameterValue
{
  template <typename... Numbers, std::enable_if_t<(std::is_arithmetic_v<Numbers> && ...), int> = 0>
  ParameterValue(Numbers... n)
    : numbers{ static_cast<double>(n)... }
  {
  }
  ParameterValue(const char* s)
    : text(s ? s : "")
    , isText(true)
  {
  }

  std::vector<double> numbers;
  std::string text;
  bool isText = false;
};

using ParameterTable = std::map<std::string, ParameterValue>;

inline vtkXMLDataElement* findProxy(vtkXMLDataElement* element, const std::string& name)
{
  const char* own = element->GetAttribute("name");
  if (own && name == own && std::string(element->GetName()).find("Proxy") != std::string::npos)
  {
    return element;
  }
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    if (vtkXMLDataElement* found = findProxy(element->GetNestedElement(i), name))
    {
      return found;
    }
  }
  return nullptr;
}

/// Properties that carry a value of the user's: not inputs, choices of arrays to process, or
/// read-only information.
inline bool isParameter(vtkXMLDataElement* property)
{
  const std::string kind = property->GetName();
  return kind.find("VectorProperty") != std::string::npos &&
    !property->GetAttribute("information_only") && !property->GetAttribute("element_types");
}

/// Expects that every parameter of a proxy is in `defaults` with the value of the XML, that its
/// command is "Set" + name, that it has a help text, and that nothing is in the table alone.
/// @param prefix only of parameters whose names begin with it
inline void expectDefaultsOfXml(const std::string& file, const std::string& proxyName,
  const ParameterTable& defaults, const std::string& prefix = "")
{
  const std::string path = std::string(PLUGIN_XML_DIR) + "/" + file;
  const auto root = vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  ASSERT_TRUE(root) << path;
  vtkXMLDataElement* proxy = findProxy(root, proxyName);
  ASSERT_TRUE(proxy) << proxyName << " in " << path;
  std::size_t found = 0;
  for (int i = 0; i < proxy->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* property = proxy->GetNestedElement(i);
    if (!isParameter(property))
    {
      continue;
    }
    const std::string name = property->GetAttribute("name");
    if (name.compare(0, prefix.size(), prefix) != 0)
    {
      continue;
    }
    const auto expected = defaults.find(name);
    ASSERT_TRUE(expected != defaults.end()) << name << " has no entry in the test's table";
    ++found;
    EXPECT_EQ(property->GetAttribute("command"), "Set" + name);
    EXPECT_TRUE(property->FindNestedElementWithName("Documentation")) << name << " has no help";
    const char* text = property->GetAttribute("default_values");
    if (expected->second.isText)
    {
      EXPECT_EQ(expected->second.text, text ? text : "") << name; // VTK drops empty attributes
      continue;
    }
    ASSERT_TRUE(text) << name << " has no default";
    std::istringstream stream(text);
    for (const double number : expected->second.numbers)
    {
      double value = -12345;
      stream >> value;
      EXPECT_EQ(value, number) << name;
    }
  }
  EXPECT_EQ(found, defaults.size());
}

#endif
