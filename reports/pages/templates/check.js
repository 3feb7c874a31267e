"use strict";
// The table of scenes and engines, and the evidence behind each of its cells. All that a run wrote is data: it becomes
// text of elements, never markup. What is not looked at is not made.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const WORDS = data.words; // the gravest first
  const GLYPHS = data.glyphs;
  const PAGE = 100; // rows that are made at a time
  const text = (number) => (number < 0 ? "" : data.text[number]);
  const byId = (id) => document.getElementById(id);

  /** An element with attributes and children; a child that is text stays text. */
  function make(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
      if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
      else if (value !== false && value !== undefined) made.setAttribute(key, value === true ? "" : value);
    }
    made.append(...children.filter((child) => child !== null && child !== undefined));
    return made;
  }

  // --- what there is

  const scenes = data.scenes.map((scene, number) => ({
    number,
    name: text(scene.name),
    command: text(scene.again),
    description: text(scene.description),
    about: scene.about.map(([label, value]) => [label, text(value)]),
    equations: scene.equations.map(([name, formula]) => [text(name), text(formula)]),
    drawing: scene.drawing,
    seen: scene.side ? "seen from the side" : "swung out",
    cells: [],
  }));
  const engines = data.engines.map((engine, number) => ({
    number, name: text(engine.name), about: text(engine.about), option: text(engine.option),
  }));

  for (const [scene, engine, word, said, share, rows] of data.cells) {
    const results = rows.map(([check, outcome, measured, allowed, of, line, reason, cause, explanation, known, details, history, matrix]) => ({
      check, word: outcome, measured: text(measured), allowed: text(allowed), share: of, line: text(line ?? -1),
      reason: text(reason ?? -1), cause: text(cause ?? -1), explanation: explanation ?? -1, known: known ?? -1,
      details: details ?? [], history: history ?? -1, matrix: matrix ?? -1,
    }));
    scenes[scene].cells[engine] = { scene, engine, word, said: text(said), share, results };
  }
  for (const scene of scenes) {
    const tags = scene.about.filter(([label]) => label === "tags").map(([, value]) => value);
    scene.searched = [scene.name, scene.description, ...tags].join("\n").toLowerCase();
  }

  const cellOf = (scene, engine) => scenes[scene].cells[engine] ?? { scene, engine, word: -1, said: "", share: -1, results: [] };
  const isNew = (result) => result.word === 0 && result.known < 0;

  // --- the table

  const state = { query: "", show: "all", check: -1, engine: -1, sort: "found", down: true, rows: PAGE, focus: "" };

  /** What a cell says: of all its checks, or of the one that was chosen. */
  function seen(cell) {
    if (state.check < 0) return cell;
    const results = cell.results.filter((result) => result.check === state.check);
    const word = WORDS.findIndex((_, number) => results.some((result) => result.word === number));
    const deciding = results.filter((result) => result.word === word).sort((a, b) => b.share - a.share)[0];
    return { ...cell, word, results, said: deciding?.measured ?? "", share: deciding?.share ?? -1 };
  }

  function shown(cell) {
    if (state.show === "all") return true;
    if (state.show === "new") return cell.results.some(isNew);
    if (state.show === "none") return cell.results.length === 0;
    if (state.show.startsWith("cause")) {
      const number = Number(state.show.slice(5));
      return cell.results.some((result) => result.explanation === number);
    }
    return cell.results.some((result) => WORDS[result.word] === state.show);
  }

  const weight = (cell) => (cell.word < 0 ? -2 : (WORDS.length - cell.word) * 1e6 + Math.log10(Math.max(cell.share, 1e-300)));

  function chosen() {
    const asked = state.query.toLowerCase().split(/\s+/).filter(Boolean);
    const columns = engines.filter((engine) => state.engine < 0 || engine.number === state.engine);
    const rows = scenes
      .filter((scene) => asked.every((word) => scene.searched.includes(word)))
      .map((scene) => ({ scene, cells: columns.map((engine) => seen(cellOf(scene.number, engine.number))) }))
      .filter((row) => row.cells.some(shown) || (state.show === "all" && !row.cells.length));
    const turn = state.down ? 1 : -1;
    if (state.sort === "name") {
      rows.sort((a, b) => turn * a.scene.name.localeCompare(b.scene.name, "en", { numeric: true }));
    } else if (state.sort !== "found") {
      const column = state.sort === "worst" ? -1 : columns.findIndex((engine) => String(engine.number) === state.sort);
      const of = (row) => (column < 0 ? Math.max(...row.cells.map(weight)) : weight(row.cells[column]));
      rows.sort((a, b) => turn * (of(b) - of(a)) || a.scene.number - b.scene.number);
    } else if (!state.down) {
      rows.reverse();
    }
    return { columns, rows };
  }

  function cellButton(cell) {
    const word = cell.word < 0 ? "no result" : WORDS[cell.word];
    const known = cell.results.some((result) => result.known >= 0);
    const said = [`${cell.word < 0 ? "" : GLYPHS[cell.word] + " "}${word}`, cell.said, known ? "known" : ""].filter(Boolean);
    const place = `${cell.scene}-${cell.engine}`;
    const visible = [
      cell.word < 0 ? null : make("span", { "aria-hidden": "true" }, `${GLYPHS[cell.word]} `),
      make("span", { class: "word" }, `${word} `),
      cell.said,
      known ? make("small", {}, " known") : null,
    ];
    const label = `${said.join(" ")}, ${scenes[cell.scene].name}, ${engines[cell.engine].name}`;
    return make("button", { type: "button", "data-place": place, tabindex: "-1", "aria-label": label }, ...visible);
  }

  function heading(label, key, about) {
    const sorted = state.sort === key;
    const button = make("button", { type: "button", "data-sort": key }, label, make("span", { class: "arrow", "aria-hidden": "true" },
      sorted ? (state.down ? " ▼" : " ▲") : ""));
    const order = sorted ? ((key === "name") === state.down ? "ascending" : "descending") : undefined;
    return make("th", { scope: "col", "aria-sort": order, title: about || undefined }, button,
      about ? make("small", {}, about) : null);
  }

  function drawTable() {
    const { columns, rows } = chosen();
    byId("matrix-head").replaceChildren(make("tr", {},
      heading("scene", "name", ""), ...columns.map((engine) => heading(engine.name, String(engine.number), engine.about))));
    byId("matrix-body").replaceChildren(...rows.slice(0, state.rows).map(({ scene, cells }) => make("tr", {},
      make("th", { scope: "row" }, make("button", { type: "button", class: "link", "data-place": String(scene.number), tabindex: "-1" },
        scene.name)),
      ...cells.map((cell) => make("td", { class: cell.word < 0 ? "none" : WORDS[cell.word] }, cellButton(cell))))));
    const left = rows.length - state.rows;
    byId("more").hidden = left <= 0;
    byId("more").textContent = `Show ${Math.min(PAGE, left)} more of ${left} scenes`;
    byId("nothing").hidden = rows.length > 0;
    const found = rows.flatMap((row) => row.cells.filter(shown));
    byId("found").textContent = `${rows.length} of ${scenes.length} scenes, ${found.length} cells`;
    placeFocus();
  }

  const buttons = () => [...byId("matrix-body").querySelectorAll("button")];

  /** One button of the table is in the order of the tab key; the arrow keys move from there. */
  function placeFocus() {
    const all = buttons();
    const one = all.find((button) => button.dataset.place === state.focus) ?? all.find((button) => button.closest("td")) ?? all[0];
    for (const button of all) button.tabIndex = button === one ? 0 : -1;
    if (one) state.focus = one.dataset.place;
  }

  function move(event) {
    const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0], Home: [0, -Infinity], End: [0, Infinity] };
    const step = steps[event.key];
    const cell = event.target.closest("th, td");
    if (!step || !cell) return;
    event.preventDefault();
    const rows = [...byId("matrix-body").rows];
    const row = rows[Math.min(Math.max(rows.indexOf(cell.parentElement) + step[0], 0), rows.length - 1)];
    const target = row.cells[Math.min(Math.max(cell.cellIndex + step[1], 0), row.cells.length - 1)].querySelector("button");
    state.focus = target.dataset.place;
    placeFocus();
    target.focus();
  }

  // --- the evidence

  const figures = (result) => make("dl", { class: "figures" }, ...result.details.flatMap((value, i) => {
    if (i % 2 === 0) return [make("dt", {}, text(value))];
    const said = text(value);
    return [make("dd", {}, said.includes("\n") ? make("pre", {}, said) : said)];
  }));

  /** A heading that makes what is under it when it is opened for the first time. */
  function folded(title, inside, open = false) {
    const details = make("details", { open }, make("summary", {}, title));
    const fill = () => { if (details.open && details.children.length === 1) details.append(inside()); };
    details.addEventListener("toggle", fill);
    fill();
    return details;
  }

  function reasonOf(result) {
    const parts = [];
    if (result.known >= 0) parts.push(make("p", {}, make("strong", {}, "known difference: "), byId(`known-${result.known}`)?.textContent ?? ""));
    if (result.cause) parts.push(make("p", {}, "cause: ", make("strong", {}, result.cause)));
    if (result.reason) parts.push(result.reason.includes("\n") ? make("pre", {}, result.reason) : make("p", {}, result.reason));
    if (result.line) parts.push(make("p", { class: "faint" }, `rounding gives at most ${result.line} in this state`));
    if (result.history >= 0) parts.push(folded("errors over time, and the motion", () => furikoMotion(data.histories[result.history], make, svg), result.word === 0));
    if (result.matrix >= 0) parts.push(folded("the matrix, entry by entry", () => furikoHeat(text(data.checks[result.check]).split(" ").at(-1), matrixOf(result.matrix), make), result.word === 0));
    if (result.details.length) parts.push(folded("state and further figures", () => figures(result)));
    return parts;
  }

  function matrixOf(number) {
    const map = data.matrices[number];
    return { ...map, state: text(map.state), rows: map.rows.map(text), columns: map.columns.map(text) };
  }

  function resultRows(result) {
    const word = WORDS[result.word];
    const reason = reasonOf(result);
    const times = result.share >= 0 && result.word !== 4 ? make("small", {}, ` (${timesOf(result.share)})`) : null;
    return make("tbody", {},
      make("tr", {},
        make("th", { scope: "rowgroup" }, text(data.checks[result.check])),
        make("td", { class: word }, `${GLYPHS[result.word]} ${word}`),
        make("td", {}, result.measured || "–", times),
        make("td", {}, result.allowed || "–")),
      reason.length ? make("tr", {}, make("td", { colspan: "4", class: "why" }, ...reason)) : null);
  }

  function timesOf(share) {
    if (share > 1e300) return "nothing is allowed";
    if (share === 0) return "exact";
    const said = share >= 0.01 && share < 1e4 ? String(Number(share.toPrecision(2))) : share.toExponential(1).replace("e+", "e");
    return `${said} × allowed`;
  }

  function again(command) {
    const code = make("code", {}, command);
    const said = make("span", { role: "status" });
    const copy = async () => {
      try {
        await navigator.clipboard.writeText(command);
        said.textContent = " copied";
      } catch {
        getSelection().selectAllChildren(code);
        said.textContent = " selected";
      }
    };
    return make("p", { class: "command" }, code, " ", make("button", { type: "button", onclick: copy }, "Copy"), said);
  }

  function causesOf(results) {
    const numbers = [...new Set(results.map((result) => result.explanation).filter((number) => number >= 0))];
    if (!numbers.length) return [];
    const copies = numbers.map((number) => {
      const told = byId(`cause-${number}`);
      const lines = [...told.querySelectorAll(".lines > li")].map((line) => make("li", {}, line.textContent));
      return make("li", {}, make("strong", {}, told.querySelector(".headline").textContent), lines.length ? make("ul", {}, ...lines) : null);
    });
    return [make("h3", {}, "Why"), make("ul", { class: "causes" }, ...copies)];
  }

  function svg(name, attributes, ...children) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  }

  function picture(drawing, seen) {
    const [width, height, x, y, lines, bobs] = drawing;
    const inside = [svg("path", { d: `M${x - 11} ${y - 3}h22`, "stroke-width": 3 })];
    for (let i = 0; i < lines.length; i += 4) {
      inside.push(svg("path", { d: `M${lines[i]} ${lines[i + 1]}L${lines[i + 2]} ${lines[i + 3]}`, "stroke-width": lines.length < 160 ? 2.5 : 1 }));
    }
    for (let i = 0; i < bobs.length; i += 3) inside.push(svg("circle", { cx: bobs[i], cy: bobs[i + 1], r: bobs[i + 2], class: "bob" }));
    return svg("svg", { class: "mechanism", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `The mechanism's links to scale, ${seen}` }, ...inside);
  }

  function mechanism(scene) {
    const facts = make("dl", {}, ...scene.about.flatMap(([label, value]) => [make("dt", {}, label), make("dd", {}, value)]));
    const found = [make("h3", {}, "The mechanism")];
    if (scene.description) found.push(make("p", {}, scene.description));
    found.push(make("div", { class: "system" }, scene.drawing ? picture(scene.drawing, scene.seen) : null, facts));
    const typeset = scene.equations.filter(([, formula]) => formula);
    const named = scene.equations.filter(([, formula]) => !formula).map(([name]) => name);
    if (typeset.length || named.length) found.push(make("h3", {}, "Equations"));
    for (const [name, formula] of typeset) {
      const body = make("div", { class: "formula", tabindex: "0", role: "group", "aria-label": `equation ${name}` });
      furikoFormula(formula).forEach((part) => body.append(make("span", {}, part)));
      found.push(make("div", { class: "equation" }, make("span", { class: "faint" }, name), body));
    }
    if (named.length) found.push(make("p", {}, named.join(", ")));
    return found;
  }

  const graveFirst = (results) => [...results].sort((a, b) => a.word - b.word);

  function cellEvidence(cell) {
    const scene = scenes[cell.scene], engine = engines[cell.engine];
    const table = make("table", { class: "results" }, make("caption", { class: "unseen" }, "Measured and allowed errors"),
      make("thead", {}, make("tr", {}, ...["check", "outcome", "measured", "allowed"].map((name) => make("th", { scope: "col" }, name)))),
      ...graveFirst(cell.results).map(resultRows));
    return [
      ...causesOf(cell.results),
      make("h3", {}, "Measured and allowed"),
      cell.results.length ? table : make("p", {}, "This run has no result of it."),
      make("h3", {}, "Run this again"),
      again(`${scene.command} ${engine.option}`.trim()),
      ...mechanism(scene),
    ];
  }

  function sceneEvidence(scene) {
    const cells = engines.map((engine) => cellOf(scene.number, engine.number));
    const checks = data.checks.map((name, number) => number).filter((number) => cells.some((cell) => cell.results.some((result) => result.check === number)));
    const rows = checks.map((check) => make("tr", {}, make("th", { scope: "row" }, text(data.checks[check])), ...cells.map((cell) => {
      const results = cell.results.filter((result) => result.check === check);
      if (!results.length) return make("td", {});
      const said = results.map((result) => make("div", { class: WORDS[result.word] }, `${GLYPHS[result.word]} ${result.measured || WORDS[result.word]}`));
      return make("td", {}, ...said);
    })));
    const head = engines.map((engine) => make("th", { scope: "col" }, make("button", { type: "button", class: "link", "data-place": `${scene.number}-${engine.number}` }, engine.name)));
    const table = make("table", { class: "matrix" }, make("thead", {}, make("tr", {}, make("th", { scope: "col" }, "check"), ...head)), make("tbody", {}, ...rows));
    return [
      ...causesOf(cells.flatMap((cell) => cell.results)),
      make("h3", {}, "Measured, by check and engine"),
      rows.length ? make("div", { class: "scroll", role: "region", tabindex: "0", "aria-label": "Measured, by check and engine" }, table) : make("p", {}, "This run has no result of it."),
      make("h3", {}, "Run this again"),
      again(scene.command),
      ...mechanism(scene),
    ];
  }

  const dialog = byId("evidence");

  function step(label, place, title) {
    return make("button", { type: "button", "data-place": place, "aria-label": title }, label);
  }

  function show(place) {
    const [scene, engine] = place.split("-").map(Number);
    if (!scenes[scene] || (engine !== undefined && !engines[engine])) return false;
    const cell = engine === undefined ? null : cellOf(scene, engine);
    byId("evidence-title").replaceChildren(scenes[scene].name, cell ? ` × ${engines[engine].name}` : "",
      cell && cell.word >= 0 ? make("span", { class: `chip ${WORDS[cell.word]}` }, `${GLYPHS[cell.word]} ${WORDS[cell.word]}`) : "");
    const steps = [];
    if (cell) {
      steps.push(step("All engines", String(scene), `${scenes[scene].name}, all engines`));
      if (engine > 0) steps.push(step(`← ${engines[engine - 1].name}`, `${scene}-${engine - 1}`, `previous engine, ${engines[engine - 1].name}`));
      if (engine < engines.length - 1) steps.push(step(`${engines[engine + 1].name} →`, `${scene}-${engine + 1}`, `next engine, ${engines[engine + 1].name}`));
    }
    byId("evidence-steps").replaceChildren(...steps);
    byId("evidence-body").replaceChildren(...(cell ? cellEvidence(cell) : sceneEvidence(scenes[scene])));
    if (!dialog.open) dialog.showModal();
    dialog.scrollTop = 0;
    byId("evidence-title").focus();
    return true;
  }

  const placeInAddress = () => (/^#[0-9]+(-[0-9]+)?$/.test(location.hash) ? location.hash.slice(1) : "");

  function followAddress() {
    const place = placeInAddress();
    if (place && show(place)) return;
    if (dialog.open) dialog.close();
  }

  function open(place) {
    if (placeInAddress() === place) show(place);
    else location.hash = place;
  }

  dialog.addEventListener("close", () => {
    if (placeInAddress()) history.replaceState(null, "", location.pathname + location.search);
    byId("evidence-body").replaceChildren();
    const button = buttons().find((one) => one.dataset.place === state.focus);
    if (button) button.focus();
  });
  dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close(); });
  byId("evidence-close").addEventListener("click", () => dialog.close());
  addEventListener("hashchange", followAddress);
  document.addEventListener("click", (event) => {
    const target = event.target.closest("[data-place], [data-sort], [data-show]");
    if (!target) return;
    if (target.dataset.place !== undefined) {
      if (target.closest("#matrix-body")) {
        state.focus = target.dataset.place;
        placeFocus();
      }
      open(target.dataset.place);
    } else if (target.dataset.sort !== undefined) {
      const key = target.dataset.sort;
      state.down = state.sort === key ? !state.down : true;
      state.sort = key;
      byId("sort").value = ["found", "worst", "name"].includes(key) ? key : "";
      drawTable();
      byId("matrix-head").querySelector(`[data-sort="${key}"]`)?.focus();
    } else {
      choose(target.dataset.show);
      byId("table").scrollIntoView();
    }
  });
  byId("matrix-body").addEventListener("keydown", move);

  // --- the controls

  const option = (value, label) => make("option", { value }, label);

  function choose(show) {
    byId("show").value = show;
    state.show = show;
    state.rows = PAGE;
    drawTable();
  }

  function prepare() {
    const occurring = WORDS.filter((_, number) => scenes.some((scene) => scene.cells.some((cell) => cell.results.some((r) => r.word === number))));
    byId("show").append(option("all", "everything"), ...(data.known ? [option("new", "differs, and is not known")] : []),
      ...occurring.map((word) => option(word, word)), option("none", "no result"),
      ...data.causes.map((cause, number) => option(`cause${number}`, `cause ${number + 1}: ${text(cause.title)}`)));
    byId("check").append(option("-1", "all checks"), ...data.checks.map((name, number) => option(String(number), text(name))));
    byId("engine").append(option("-1", "all engines"), ...engines.map((engine) => option(String(engine.number), engine.name)));
    const change = (id, take) => byId(id).addEventListener("input", () => { take(byId(id).value); state.rows = PAGE; drawTable(); });
    change("query", (value) => { state.query = value; });
    change("show", (value) => { state.show = value; });
    change("check", (value) => { state.check = Number(value); });
    change("engine", (value) => { state.engine = Number(value); });
    change("sort", (value) => { state.sort = value; state.down = true; });
    byId("more").addEventListener("click", () => {
      const before = state.rows;
      state.rows += PAGE;
      drawTable();
      byId("matrix-body").rows[before]?.querySelector("button").focus();
    });
    byId("filters").addEventListener("submit", (event) => event.preventDefault());
    byId("filters").addEventListener("reset", () => setTimeout(() => {
      Object.assign(state, { query: "", show: "all", check: -1, engine: -1, sort: byId("sort").value, down: true, rows: PAGE });
      drawTable();
    }));
    for (const item of document.querySelectorAll(".counts li[data-word]")) {
      item.replaceChildren(make("button", { type: "button", "data-show": item.dataset.word, title: "show these in the table" }, item.textContent));
    }
    data.causes.forEach((cause, number) => {
      const told = byId(`cause-${number}`);
      if (cause.explained) told.append(make("button", { type: "button", class: "link", "data-show": `cause${number}` }, "Show them in the table"));
      if (cause.places.length) {
        told.append(folded("Each place and value", () => make("ul", {}, ...cause.places.map(([sentence, where]) =>
          make("li", {}, text(sentence), make("span", { class: "faint" }, ` (${text(where)})`))))));
      }
    });
    if (data.grave) {
      state.sort = "worst";
      byId("sort").querySelector('[value="worst"]').setAttribute("selected", "");
      byId("sort").value = "worst";
    }
    byId("table").hidden = false;
    drawTable();
    followAddress();
  }

  prepare();
})();
