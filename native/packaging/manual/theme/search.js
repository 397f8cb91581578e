// SPDX-License-Identifier: GPL-3.0-or-later
// Search in all pages, without a server: search_index.js has made `sections`, rows of
// [address, title of the page, heading, text].
"use strict";

const field = document.querySelector("header input");
const results = document.getElementById("results");
const article = document.querySelector("article");
const base = new URL(".", document.currentScript.src);
const AT_MOST = 30;

const wordsOf = (text) => text.toLowerCase().split(/\s+/).filter(Boolean);

// How well a section answers; 0 unless it has all words. Headings count most, whole words more than parts.
function score([, title, heading, text], words) {
  let sum = 0;
  for (const word of words) {
    const here = 10 * worth(heading, word) + 2 * worth(text, word);
    if (here === 0) return 0;
    sum += here + 3 * worth(title, word);
  }
  return sum;
}

// 2 for a word that stands by itself, 1 for a part of one.
function worth(text, word) {
  const literally = word.replace(/[\\^$.*+?()[\]{}|/]/g, "\\$&");
  if (new RegExp(`(?<![\\p{L}\\p{N}_])${literally}(?![\\p{L}\\p{N}_])`, "iu").test(text)) return 2;
  return text.toLowerCase().includes(word) ? 1 : 0;
}

function find(words) {
  return sections
    .map((section) => [score(section, words), section])
    .filter(([points]) => points > 0)
    .sort((a, b) => b[0] - a[0]) // equal ones stay in the order of the pages
    .map(([, section]) => section);
}

function element(tag, text, parent) {
  const made = document.createElement(tag);
  made.textContent = text;
  parent.append(made);
  return made;
}

// The words round the first place where one is found, with all of them marked.
function excerpt(text, words, parent) {
  const low = text.toLowerCase();
  const places = words.map((word) => low.indexOf(word)).filter((place) => place >= 0);
  const from = Math.max(0, low.lastIndexOf(" ", Math.min(...places, low.length) - 60) + 1);
  const shown = text.slice(places.length ? from : 0).slice(0, 220);
  let rest = (places.length && from ? "… " : "") + shown + (shown.length === 220 ? " …" : "");
  while (rest) {
    const hits = words.map((word) => [rest.toLowerCase().indexOf(word), word.length]);
    const [place, length] = hits.filter((hit) => hit[0] >= 0).sort((a, b) => a[0] - b[0] || b[1] - a[1])[0] ?? [rest.length, 0];
    parent.append(rest.slice(0, place));
    if (length) element("mark", rest.slice(place, place + length), parent);
    rest = rest.slice(place + length);
  }
}

function show() {
  const words = wordsOf(field.value);
  results.hidden = words.length === 0;
  article.hidden = words.length > 0;
  if (words.length === 0) return;
  const found = find(words);
  results.replaceChildren();
  element("h1", found.length === 1 ? "1 place" : `${found.length} places`, results);
  for (const [address, title, heading, text] of found.slice(0, AT_MOST)) {
    const link = element("a", heading, element("h3", "", results));
    link.href = new URL(address, base);
    link.addEventListener("click", () => { field.value = ""; show(); }); // it may lead to this page
    if (title !== heading) element("small", ` ${title}`, link.parentElement);
    excerpt(text, words, element("p", "", results));
  }
  if (found.length > AT_MOST) element("p", `The best ${AT_MOST} are shown; one more word narrows it.`, results);
}

field.addEventListener("input", show);
document.querySelector("header form").addEventListener("submit", (event) => {
  event.preventDefault();
  results.querySelector("a")?.focus();
});
field.value = new URLSearchParams(location.search).get("search") ?? "";
show();
