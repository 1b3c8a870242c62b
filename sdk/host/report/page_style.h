// The look of the report's page.
#pragma once

namespace sphc::host {

inline constexpr char kPageStyle[] = R"css(
:root { --ink:#0f172a; --soft:#475569; --line:#e2e8f0; --paper:#ffffff; --ground:#f1f5f9; --blue:#2563eb; --good:#16a34a;
        --fair:#d97706; --bad:#dc2626; }
* { box-sizing:border-box; }
body { margin:0; background:var(--ground); color:var(--ink); font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,
       "Helvetica Neue",Arial,sans-serif; }
header { background:linear-gradient(120deg,#0f172a,#1e3a8a 70%,#2563eb); color:#fff; padding:2.4rem 0 5rem; }
header > div, main { max-width:1180px; margin:0 auto; padding:0 1.5rem; }
header h1 { margin:0 0 .3rem; font-size:2rem; letter-spacing:-.02em; }
header p { margin:0; opacity:.85; max-width:110ch; }
main { padding-bottom:3rem; margin-top:-3.4rem; }
.cards { display:grid; grid-template-columns:repeat(auto-fit,minmax(165px,1fr)); gap:.9rem; }
.card, section { background:var(--paper); border-radius:14px; box-shadow:0 1px 3px rgba(15,23,42,.12); }
.card { padding:1rem 1.1rem; border-top:4px solid var(--blue); }
.card.good { border-color:var(--good); } .card.fair { border-color:var(--fair); } .card.bad { border-color:var(--bad); }
.card b { display:block; font-size:1.65rem; letter-spacing:-.02em; line-height:1.2; }
.card span { color:var(--soft); font-size:.86rem; }
section { margin-top:1.2rem; padding:1.4rem 1.6rem 1.6rem; }
h2 { margin:0 0 .4rem; font-size:1.25rem; letter-spacing:-.01em; }
h3 { margin:.2rem 0 .3rem; font-size:1rem; }
p { margin:.3rem 0 .8rem; } .soft, figcaption { color:var(--soft); font-size:.9rem; }
.pictures { display:grid; grid-template-columns:repeat(auto-fit,minmax(420px,1fr)); gap:1.3rem; align-items:start; }
figure { margin:0; min-width:0; } figure.wide { grid-column:1/-1; }
figure img, figure svg { width:100%; height:auto; border-radius:10px; display:block; }
figure img { cursor:zoom-in; outline:none; }
figure img:focus { position:fixed; inset:2vh 2vw; width:96vw; height:96vh; object-fit:contain; z-index:9; cursor:zoom-out;
                   background:rgba(15,23,42,.92); }
.overlays { grid-template-columns:repeat(auto-fit,minmax(340px,1fr)); }
figure svg { border:1px solid var(--line); background:#fff; }
table { border-collapse:collapse; width:100%; font-size:.93rem; }
th { text-align:left; color:var(--soft); font-weight:600; } th, td { padding:.36rem .9rem .36rem 0; vertical-align:top; }
tr + tr td, thead + tbody td { border-top:1px solid var(--line); }
td.value { font-variant-numeric:tabular-nums; white-space:nowrap; font-weight:600; }
.columns { display:grid; grid-template-columns:repeat(auto-fit,minmax(320px,1fr)); gap:1.4rem 2.4rem; margin-top:1.2rem; }
.key { display:inline-block; width:.75em; height:.75em; border-radius:50%; border:2.5px solid; margin:0 .25em 0 .1em; }
.wrong { background:#fee2e2; color:#7f1d1d; }
p.wrong { border-left:4px solid var(--bad); padding:.7rem 1rem; border-radius:8px; }
.warn { background:#fef3c7; border-left:4px solid var(--fair); padding:.7rem 1rem; border-radius:8px; }
code { font-size:.9em; background:var(--ground); padding:.08em .35em; border-radius:5px; word-break:break-all; }
footer { color:var(--soft); font-size:.85rem; margin-top:1.4rem; }
@media (max-width:560px) { .pictures { grid-template-columns:1fr; } }
@media print { body { background:#fff; } section, .card { box-shadow:none; border:1px solid var(--line); break-inside:avoid; } }
)css";

}  // namespace sphc::host
