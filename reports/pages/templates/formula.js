"use strict";
// Typesets a formula that is written as text: θ̇₁² sin(θ₁ − θ₂), Σᵢ₌₂ⁿ⁺¹ mᵢ, lⱼ/2, [a, b; c, d]. Elements are made one by
// one and hold text alone, whatever stands in the formula.
const furikoFormula = (() => {
  const LONGEST = 2000; // characters; longer formulas are shown as they are written
  const DEEPEST = 20; // brackets inside brackets
  const LOW = { "₊": "+", "₋": "−", "₌": "=", "ᵢ": "i", "ⱼ": "j", "ₖ": "k", "ₗ": "l", "ₘ": "m", "ₙ": "n", "ₐ": "a",
    "ₑ": "e", "ₒ": "o", "ₓ": "x", "ₚ": "p", "ₛ": "s", "ₜ": "t", "ᵣ": "r", "ᵤ": "u", "ᵥ": "v" };
  const HIGH = { "⁺": "+", "⁻": "−", "⁼": "=", "ⁿ": "n", "ⁱ": "i", "ʲ": "j", "ᵏ": "k", "ᵀ": "T" };
  [..."₀₁₂₃₄₅₆₇₈₉"].forEach((sign, digit) => { LOW[sign] = String(digit); });
  [..."⁰¹²³⁴⁵⁶⁷⁸⁹"].forEach((sign, digit) => { HIGH[sign] = String(digit); });
  const ACCENTS = { "\u0302": "^", "\u0307": "˙", "\u0308": "¨", "\u0304": "¯", "\u0303": "~" };
  const HALVES = { "½": ["1", "2"], "⅓": ["1", "3"], "¼": ["1", "4"] };
  const FUNCTIONS = new Set(["sin", "cos", "tan", "exp", "log", "ln", "det"]);
  const SHORT_WORDS = new Set(["as", "at", "if", "in", "is", "of", "on", "or", "to"]);
  const CLOSING = { "(": ")", "[": "]", "{": "}" };

  function element(name, ...children) {
    const made = document.createElementNS("http://www.w3.org/1998/Math/MathML", name);
    made.append(...children);
    return made;
  }

  function thinSpace() {
    const space = element("mspace");
    space.setAttribute("width", "0.17em");
    return space;
  }

  const row = (nodes) => (nodes.length === 1 ? nodes[0] : element("mrow", ...nodes));

  class Reader {
    constructor(text) {
      this.signs = [...text];
      this.at = 0;
      this.depth = 0;
    }

    get next() { return this.signs[this.at]; }

    /** Items up to a closing bracket: [node, whether an operator, whether a space stands before it]. */
    items(closing) {
      const found = [];
      let spaced = true;
      while (this.at < this.signs.length && this.next !== closing) {
        const sign = this.next;
        if (/\s/.test(sign)) {
          this.at += 1;
          spaced = true;
        } else if (closing === "]" && (sign === "," || sign === ";")) {
          break;
        } else if (sign === "/" && found.length && !spaced && !found.at(-1).operator) {
          this.at += 1;
          this.divide(found);
        } else {
          for (const item of this.atoms()) {
            if (item.name && found.length && !found.at(-1).operator) found.push({ node: thinSpace(), operator: true });
            found.push({ ...item, spaced });
            if (item.name && this.next !== "(") found.push({ node: thinSpace(), operator: true });
            spaced = false;
          }
        }
      }
      return found;
    }

    /** What stands before a stroke without a space becomes the numerator, what stands behind it the denominator. */
    divide(found) {
      const above = [];
      let first;
      do {
        first = found.pop();
        above.unshift(first.node);
      } while (!first.spaced && found.length && !found.at(-1).operator);
      const below = [];
      while (this.at < this.signs.length && !/[\s)\]},;+−=·/]/.test(this.next)) {
        below.push(...this.atoms().map((item) => item.node));
      }
      const node = element("mfrac", row(above), row(below));
      found.push({ node, operator: false, spaced: first.spaced });
    }

    /** One sign, number, name or bracket with its indices; a name of several letters may be several items. */
    atoms() {
      const sign = this.next;
      if (CLOSING[sign] && this.depth < DEEPEST) return [{ node: this.indexed(this.bracket(sign)), operator: false }];
      if (/[0-9]/.test(sign)) return [{ node: this.indexed(element("mn", this.run(/[0-9.]/))), operator: false }];
      if (/[A-Za-z]/.test(sign)) return this.word();
      this.at += 1;
      if (HALVES[sign]) {
        const [above, below] = HALVES[sign];
        return [{ node: element("mfrac", element("mn", above), element("mn", below)), operator: false }];
      }
      if (sign === "Σ" || sign === "∑" || sign === "∫") {
        return [{ node: this.indexed(element("mo", sign === "Σ" ? "∑" : sign), sign !== "∫"), operator: true }];
      }
      if (sign === "∂" || sign === "∞" || /\p{L}/u.test(sign)) {
        return [{ node: this.indexed(this.accented(sign)), operator: false }];
      }
      return [{ node: this.indexed(element("mo", sign === "-" ? "−" : sign)), operator: sign !== "|" }];
    }

    run(kind) {
      const from = this.at;
      while (this.at < this.signs.length && kind.test(this.next)) this.at += 1;
      return this.signs.slice(from, this.at).join("");
    }

    word() {
      const from = this.at;
      const letters = this.run(/[A-Za-z]/);
      if (FUNCTIONS.has(letters)) return [{ node: this.indexed(element("mi", letters)), operator: true, name: true }];
      if (letters.length > 2 || SHORT_WORDS.has(letters)) {
        return [{ node: element("mtext", `\u00a0${letters}\u00a0`), operator: true }];
      }
      this.at = from;
      return [...letters].map((letter) => {
        this.at += 1;
        return { node: this.indexed(this.accented(letter)), operator: false };
      });
    }

    accented(letter) {
      const [base, ...marks] = [...letter.normalize("NFD")];
      while (/\p{M}/u.test(this.next ?? "")) {
        marks.push(this.next);
        this.at += 1;
      }
      return marks.reduce((inner, mark) => {
        const over = element("mover", inner, element("mo", ACCENTS[mark] ?? mark));
        over.setAttribute("accent", "true");
        return over;
      }, element("mi", base));
    }

    indexed(base, limits = false) {
      let low = "", high = "";
      for (;;) {
        const sign = this.next, after = this.signs[this.at + 1];
        if (LOW[sign] !== undefined) low += LOW[sign];
        else if (low && (sign === "∨" || sign === ",") && LOW[after] !== undefined) low += sign;
        else if (HIGH[sign] !== undefined) high += HIGH[sign];
        else if (sign === "_" && /[A-Za-z0-9]/.test(after ?? "")) {
          this.at += 1;
          low += this.run(/[A-Za-z0-9]/);
          this.at -= 1;
        } else break;
        this.at += 1;
      }
      if (!low && !high) return base;
      const parts = [base, ...[low, high].filter(Boolean).map(index)];
      const kind = low && high ? (limits ? "munderover" : "msubsup") : low ? (limits ? "munder" : "msub")
        : limits ? "mover" : "msup";
      return element(kind, ...parts);
    }

    /** Brackets, and a matrix where they hold rows: [a, b; c, d]. */
    bracket(opening) {
      const closing = CLOSING[opening];
      this.at += 1;
      this.depth += 1;
      const rows = [[]];
      for (;;) {
        rows.at(-1).push(this.items(closing).map((item) => item.node));
        const sign = this.next;
        if (opening !== "[" || (sign !== "," && sign !== ";")) break;
        if (sign === ";") rows.push([]);
        this.at += 1;
      }
      this.depth -= 1;
      const end = this.next === closing ? closing : "";
      this.at += 1;
      let inside;
      if (rows.length > 1) {
        inside = [element("mtable", ...rows.map((cells) => element("mtr", ...cells.map((cell) => element("mtd", ...cell)))))];
      } else {
        inside = rows[0].flatMap((cell, i) => (i ? [element("mo", ","), ...cell] : cell));
      }
      return element("mrow", element("mo", opening), ...inside, element("mo", end));
    }
  }

  function index(text) {
    const parts = text.match(/[0-9]+|./gu).map((part) =>
      element(/[0-9]/.test(part) ? "mn" : /\p{L}/u.test(part) ? "mi" : "mo", part));
    return row(parts);
  }

  /** Formulas that stand in a line with commas between them, one by one. */
  function parts(text) {
    const signs = [...text];
    const found = [""];
    let depth = 0;
    signs.forEach((sign, i) => {
      if ("([{".includes(sign)) depth += 1;
      if (")]}".includes(sign)) depth -= 1;
      const inIndex = LOW[signs[i - 1]] !== undefined && LOW[signs[i + 1]] !== undefined;
      if ((sign === "," || sign === ";") && depth <= 0 && !inIndex) found.push("");
      else found[found.length - 1] += sign;
    });
    return found.map((part) => part.trim()).filter(Boolean);
  }

  /** The elements for a formula: mathematics, or text where it is too long to be one. */
  return function typeset(text) {
    if (text.length > LONGEST) return [document.createTextNode(text)];
    return parts(text).map((part) => {
      const reader = new Reader(part);
      const nodes = [];
      while (reader.at < reader.signs.length) {
        nodes.push(...reader.items("").map((item) => item.node));
      }
      return element("math", element("mrow", ...nodes));
    });
  };
})();
