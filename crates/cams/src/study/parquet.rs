//! The table of a study as Parquet, made from its CSV when that is complete: columns of numbers as doubles, of truths as booleans, the others
//! as text; an empty cell is null. The unit of each column with one is in the metadata of the file, under `unit.NAME`.
//!
//! Specification: <https://parquet.apache.org/docs/file-format/>. Only a group of rows is in memory.

use super::table::{cells, each_row};
use crate::write::html::unit_of;
use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::io::{self, BufRead, Write};
use std::sync::Arc;

/// Rows of a group: some ten megabytes of a table with twenty columns.
const GROUP: usize = 1 << 16;

/// What all cells of a column that are not empty are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CellKind {
    Empty,
    Number,
    Truth,
    Text,
}

impl CellKind {
    fn from_cell(cell: &str) -> Self {
        match cell {
            "" => Self::Empty,
            "true" | "false" => Self::Truth,
            other if other.parse::<f64>().is_ok() => Self::Number,
            _ => Self::Text,
        }
    }

    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Empty, kind) | (kind, Self::Empty) => kind,
            (a, b) if a == b => a,
            _ => Self::Text,
        }
    }

    fn physical(self) -> PhysicalType {
        match self {
            Self::Number => PhysicalType::DOUBLE,
            Self::Truth => PhysicalType::BOOLEAN,
            Self::Empty | Self::Text => PhysicalType::BYTE_ARRAY,
        }
    }
}

fn failed(error: ParquetError) -> io::Error {
    io::Error::other(error)
}

/// A column of a group: the values, and for each row whether it has one.
fn add(
    group: &mut SerializedRowGroupWriter<'_, impl Write + Send>,
    kind: CellKind,
    cells: &[String],
) -> io::Result<()> {
    let levels: Vec<i16> = cells.iter().map(|cell| i16::from(!cell.is_empty())).collect();
    let there = cells.iter().filter(|cell| !cell.is_empty());
    let mut column = group.next_column().map_err(failed)?.ok_or_else(|| io::Error::other("a column too many"))?;
    let written = match kind {
        CellKind::Number => {
            let values: Vec<f64> = there.filter_map(|cell| cell.parse().ok()).collect();
            column.typed::<DoubleType>().write_batch(&values, Some(&levels), None)
        }
        CellKind::Truth => {
            let values: Vec<bool> = there.map(|cell| cell == "true").collect();
            column.typed::<BoolType>().write_batch(&values, Some(&levels), None)
        }
        CellKind::Empty | CellKind::Text => {
            let values: Vec<ByteArray> = there.map(|cell| cell.as_str().into()).collect();
            column.typed::<ByteArrayType>().write_batch(&values, Some(&levels), None)
        }
    };
    written.map_err(failed)?;
    column.close().map_err(failed)
}

/// The columns of a table in the form of Parquet.
fn schema(names: &[String], kinds: &[CellKind]) -> Result<Type, ParquetError> {
    let fields = names.iter().zip(kinds).map(|(name, kind)| {
        let text = (kind.physical() == PhysicalType::BYTE_ARRAY).then_some(LogicalType::String);
        let builder = Type::primitive_type_builder(name, kind.physical());
        Ok(Arc::new(builder.with_repetition(Repetition::OPTIONAL).with_logical_type(text).build()?))
    });
    let fields: Vec<Arc<Type>> = fields.collect::<Result<_, ParquetError>>()?;
    Type::group_type_builder("study").with_fields(fields).build()
}

/// Writes the table that `open` reads, whose header is this.
///
/// # Errors
/// What reading and writing give.
pub(super) fn write<T: BufRead>(
    header: &str,
    open: impl Fn() -> io::Result<T>,
    out: impl Write + Send,
) -> io::Result<()> {
    let names = cells(header.trim_end());
    let mut kinds = vec![CellKind::Empty; names.len()];
    each_row(&mut open()?, |_, row| {
        for (kind, cell) in kinds.iter_mut().zip(row) {
            *kind = kind.and(CellKind::from_cell(cell));
        }
    })?;
    let units = names.iter().filter_map(|name| Some(KeyValue::new(format!("unit.{name}"), unit_of(name)?.to_owned())));
    let program = format!("camgen {}", env!("CARGO_PKG_VERSION"));
    let properties = WriterProperties::builder().set_created_by(program).set_key_value_metadata(Some(units.collect()));
    let schema = Arc::new(schema(&names, &kinds).map_err(failed)?);
    let mut file = SerializedFileWriter::new(out, schema, Arc::new(properties.build())).map_err(failed)?;
    let mut columns: Vec<Vec<String>> = vec![Vec::new(); names.len()];
    let mut written = Ok(());
    let mut flush = |columns: &mut Vec<Vec<String>>| -> io::Result<()> {
        let mut group = file.next_row_group().map_err(failed)?;
        for (column, kind) in columns.iter_mut().zip(&kinds) {
            add(&mut group, *kind, column)?;
            column.clear();
        }
        group.close().map(|_| ()).map_err(failed)
    };
    each_row(&mut open()?, |_, row| {
        for (column, cell) in columns.iter_mut().zip(row) {
            column.push(cell.clone());
        }
        if written.is_ok() && columns.first().is_some_and(|column| column.len() == GROUP) {
            written = flush(&mut columns);
        }
    })?;
    written?;
    if columns.first().is_some_and(|column| !column.is_empty()) {
        flush(&mut columns)?;
    }
    file.close().map(|_| ()).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    #[test]
    fn a_table_comes_back_with_its_types_and_units() {
        let header = "row,set.cam.base_radius_mm,passed,checks.wall.verdict,fault\n";
        let table = format!("{header}0,30.5,true,pass,\n1,,,,\"no, \"\"it\"\" jams\"\n2,1e-3,false,fail,\n");
        let mut bytes = Vec::new();
        write(header, || Ok(table.as_bytes()), &mut bytes).expect("a file");
        let mut again = Vec::new();
        write(header, || Ok(table.as_bytes()), &mut again).expect("a file");
        assert_eq!(bytes, again);
        let mut stored = tempfile::tempfile().expect("a file");
        stored.write_all(&bytes).expect("written");
        let file = SerializedFileReader::new(stored).expect("Parquet");
        let metadata = file.metadata().file_metadata().key_value_metadata().expect("metadata");
        let unit = metadata.iter().find(|pair| pair.key == "unit.set.cam.base_radius_mm").expect("a unit");
        assert_eq!((unit.value.as_deref(), metadata.len()), (Some("mm"), 1));
        let rows: Vec<Vec<Field>> = file
            .get_row_iter(None)
            .expect("rows")
            .map(|row| row.expect("a row").get_column_iter().map(|(_, field)| field.clone()).collect())
            .collect();
        let text = |text: &str| Field::Str(text.to_owned());
        let first = [Field::Double(0.0), Field::Double(30.5), Field::Bool(true), text("pass"), Field::Null];
        assert_eq!(rows[0], first);
        assert_eq!(rows[1][1..4], [Field::Null, Field::Null, Field::Null]);
        assert_eq!(rows[1][4], text("no, \"it\" jams"));
        assert_eq!(rows[2][1], Field::Double(1e-3));
    }
}
