"use strict";
// A matrix as a heat map: colour is the error over what rounding explains. Every value is also text: an entry that the
// pointer, a finger or the arrow keys stand on is said in words.
const furikoHeat = (() => {
  const WAYS = [["relative", "relative errors"], ["roundings", "errors [ε]"], ["engine", "engine"], ["theory", "theory"]];
  const STEPS = ["exact", "to 0.1", "to 1", "to 10⁵", "to 10¹⁰", "more"]; // times what rounding explains
  const LIMITS = [0, 0.1, 1, 1e5, 1e10];

  const short = (value) => (value === 0 ? "0" : Math.abs(value) >= 0.01 && Math.abs(value) < 1e4 ? String(Number(value.toPrecision(3))) : value.toExponential(1).replace("e+", "e"));

  function heat(roundings, allowed) {
    const step = LIMITS.findIndex((limit) => roundings / allowed <= limit);
    return step < 0 ? LIMITS.length : step;
  }

  return function show(name, map, make) {
    const { rows, columns, theory, error, roundings, allowed } = map;
    const relative = (i, j) => (theory[i][j] === 0 ? null : Math.abs(error[i][j] / theory[i][j]));
    const values = {
      roundings: (i, j) => short(roundings[i][j]),
      relative: (i, j) => (relative(i, j) === null ? (error[i][j] === 0 ? "0" : "–") : short(relative(i, j))),
      engine: (i, j) => short(theory[i][j] + error[i][j]),
      theory: (i, j) => short(theory[i][j]),
    };
    const now = make("output", { class: "entry" });
    const way = make("select", { oninput: () => fill() }, ...WAYS.map(([value, label]) => make("option", { value }, label)));
    const cells = rows.map((_, i) => columns.map((_, j) => make("td", { role: "gridcell", tabindex: "-1", class: `h${heat(roundings[i][j], allowed)}` })));
    let at = [0, 0];
    rows.forEach((_, i) => columns.forEach((_, j) => { if (roundings[i][j] > roundings[at[0]][at[1]]) at = [i, j]; }));

    function words(i, j) {
      const part = relative(i, j);
      const off = error[i][j] === 0 ? "no error" : `off by ${short(error[i][j])}${part === null ? "" : `, ${short(part)} of the entry`}`;
      return `${name}[${rows[i]}, ${columns[j]}]: engine ${Number((theory[i][j] + error[i][j]).toPrecision(9))}, theory ${theory[i][j]}: ${off}; ${short(roundings[i][j])} ε, rounding explains ${short(allowed)} ε`;
    }

    function stand(i, j) {
      cells[at[0]][at[1]].tabIndex = -1;
      at = [i, j];
      cells[i][j].tabIndex = 0;
      now.textContent = words(i, j);
    }

    function fill() {
      cells.forEach((row, i) => row.forEach((cell, j) => {
        cell.textContent = values[way.value](i, j);
        cell.setAttribute("aria-label", words(i, j));
      }));
    }

    function place(target) {
      const cell = target.closest("td");
      const i = cells.findIndex((row) => row.includes(cell));
      return i < 0 ? null : [i, cells[i].indexOf(cell)];
    }

    const look = (event) => { const found = place(event.target); if (found) stand(...found); };
    const body = make("table", { role: "grid", class: "heat", "aria-label": `${name}, entry by entry`, onpointerover: look, onclick: (event) => { look(event); cells[at[0]][at[1]].focus(); }, onfocusin: look },
      make("thead", {}, make("tr", {}, make("td", {}), ...columns.map((label) => make("th", { scope: "col" }, label)))),
      make("tbody", {}, ...rows.map((label, i) => make("tr", {}, make("th", { scope: "row" }, label), ...cells[i]))));
    body.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[event.key];
      if (!step) return;
      event.preventDefault();
      stand(Math.min(Math.max(at[0] + step[0], 0), rows.length - 1), Math.min(Math.max(at[1] + step[1], 0), columns.length - 1));
      cells[at[0]][at[1]].focus();
    });
    fill();
    stand(...at);
    const legend = make("ul", { class: "legend" }, ...STEPS.map((label, step) => make("li", {}, make("span", { class: `swatch h${step}`, "aria-hidden": "true" }), label)));
    return make("div", {},
      make("p", {}, `In state '${map.state}', in which the engine is furthest off. `, make("label", {}, "Show ", way)),
      make("div", { class: "scroll" }, body), make("p", { class: "faint" }, "Colour: the error as a multiple of what rounding explains."), legend, now);
  };
})();
