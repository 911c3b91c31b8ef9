//! The tables in `docs` that map members of other APIs to Rust.

/// The cells of a line; a quoted one may hold commas, and none holds quotes.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    for character in line.chars() {
        match character {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            _ => cells.last_mut().expect("there is one from the start").push(character),
        }
    }
    cells
}

/// The rows below the head, which must name these columns.
///
/// # Panics
/// If the table has another form.
pub fn rows<const N: usize>(table: &str, columns: [&str; N]) -> Vec<[String; N]> {
    let mut rows = table.lines().map(|line| {
        let cells = cells(line);
        cells.try_into().unwrap_or_else(|cells| panic!("{cells:?} are not the cells of a row"))
    });
    assert_eq!(rows.next(), Some(columns.map(String::from)));
    rows.collect()
}
