// SPDX-License-Identifier: BSD-3-Clause
#include "ElementRadii.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>

namespace po
{
namespace
{
struct Element
{
  std::string_view symbol;
  double radius = 2.0; ///< ångström
};

/// By atomic number, from 1. Numbers of Mantina et al. are marked with M.
constexpr std::array<Element, 118> Elements{ {
  { "H", 1.20 }, { "He", 1.40 },                                                     //
  { "Li", 1.82 }, { "Be", 1.53 /*M*/ }, { "B", 1.92 /*M*/ }, { "C", 1.70 },          //
  { "N", 1.55 }, { "O", 1.52 }, { "F", 1.47 }, { "Ne", 1.54 },                       //
  { "Na", 2.27 }, { "Mg", 1.73 }, { "Al", 1.84 /*M*/ }, { "Si", 2.10 },              //
  { "P", 1.80 }, { "S", 1.80 }, { "Cl", 1.75 }, { "Ar", 1.88 },                      //
  { "K", 2.75 }, { "Ca", 2.31 /*M*/ }, { "Sc" }, { "Ti" }, { "V" }, { "Cr" },        //
  { "Mn" }, { "Fe" }, { "Co" }, { "Ni", 1.63 }, { "Cu", 1.40 }, { "Zn", 1.39 },      //
  { "Ga", 1.87 }, { "Ge", 2.11 /*M*/ }, { "As", 1.85 }, { "Se", 1.90 },              //
  { "Br", 1.85 }, { "Kr", 2.02 },                                                    //
  { "Rb", 3.03 /*M*/ }, { "Sr", 2.49 /*M*/ }, { "Y" }, { "Zr" }, { "Nb" }, { "Mo" }, //
  { "Tc" }, { "Ru" }, { "Rh" }, { "Pd", 1.63 }, { "Ag", 1.72 }, { "Cd", 1.58 },      //
  { "In", 1.93 }, { "Sn", 2.17 }, { "Sb", 2.06 /*M*/ }, { "Te", 2.06 },              //
  { "I", 1.98 }, { "Xe", 2.16 },                                                     //
  { "Cs", 3.43 /*M*/ }, { "Ba", 2.68 /*M*/ }, { "La" }, { "Ce" }, { "Pr" },          //
  { "Nd" }, { "Pm" }, { "Sm" }, { "Eu" }, { "Gd" }, { "Tb" }, { "Dy" }, { "Ho" },    //
  { "Er" }, { "Tm" }, { "Yb" }, { "Lu" }, { "Hf" }, { "Ta" }, { "W" }, { "Re" },     //
  { "Os" }, { "Ir" }, { "Pt", 1.75 }, { "Au", 1.66 }, { "Hg", 1.55 },                //
  { "Tl", 1.96 }, { "Pb", 2.02 }, { "Bi", 2.07 /*M*/ }, { "Po", 1.97 /*M*/ },        //
  { "At", 2.02 /*M*/ }, { "Rn", 2.20 /*M*/ },                                        //
  { "Fr", 3.48 /*M*/ }, { "Ra", 2.83 /*M*/ }, { "Ac" }, { "Th" }, { "Pa" },          //
  { "U", 1.86 }, { "Np" }, { "Pu" }, { "Am" }, { "Cm" }, { "Bk" }, { "Cf" },         //
  { "Es" }, { "Fm" }, { "Md" }, { "No" }, { "Lr" }, { "Rf" }, { "Db" }, { "Sg" },    //
  { "Bh" }, { "Hs" }, { "Mt" }, { "Ds" }, { "Rg" }, { "Cn" }, { "Nh" }, { "Fl" },    //
  { "Mc" }, { "Lv" }, { "Ts" }, { "Og" }                                             //
} };

/// The letters of a symbol as they are written: the first one large.
std::string lettersOf(std::string_view text)
{
  std::string letters;
  for (const char c : text)
  {
    const auto character = static_cast<unsigned char>(c);
    if (std::isalpha(character))
    {
      letters +=
        static_cast<char>(letters.empty() ? std::toupper(character) : std::tolower(character));
    }
    else if (!letters.empty() || !std::isspace(character))
    {
      break;
    }
  }
  return letters;
}
}

int atomicNumberOf(std::string_view symbol)
{
  const std::string letters = lettersOf(symbol);
  const auto* const found = std::find_if(Elements.begin(), Elements.end(),
    [&](const Element& element) { return element.symbol == letters; });
  return found == Elements.end() ? 0 : static_cast<int>(found - Elements.begin()) + 1;
}

double vanDerWaalsRadius(int atomicNumber)
{
  const bool isElement = atomicNumber >= 1 && atomicNumber <= static_cast<int>(Elements.size());
  return isElement ? Elements[static_cast<std::size_t>(atomicNumber) - 1].radius : std::nan("");
}
}
